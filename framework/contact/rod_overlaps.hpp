// Overlap area of two rods at the start of a step: the common area of the projections of two of
// their edges along their shortest connection. Each projection is a rectangle, as long as the edge
// and as wide as the rod. Sums over edges do not depend on the meshes:
//   crossing rods   the parallelogram w_1 w_2 / sin(theta)
//   parallel rods   the length over which they lie side by side times the smaller width
// Crossing rods carry all of this area by the pair of edges with the closest points, which move
// along with them: elsewhere in the parallelogram the axes are farther apart than the rods, which
// are as wide as they are. Nearly parallel rods have no unique closest points: the vertices of both
// carry half of the area each. In between, both carry a part.
#pragma once

#include <array>
#include <vector>

#include "framework/contact/lagged_surface.hpp"
#include "framework/contact/pair_table.hpp"

namespace tack {

// The area that two rectangles around the segments (a0, a1) and (b0, b1), of those widths and
// across the unit vector n, have in common when they are seen along n [m^2]. centre: that of the
// common part, if there is one.
double shadow_overlap(const std::array<Vec3, 2>& a, double width_a, const std::array<Vec3, 2>& b,
                      double width_b, const Vec3& n, Vec3& centre);
// That of a disc of radius r and a strip of that width that runs through its centre [m^2].
double disc_overlap(double radius, double width);

class RodOverlaps {
 public:
  struct Crossing {
    std::array<int, 2> edges;  // of the mesh
    double area;               // m^2
  };

  RodOverlaps(const ContactSurface& surface, const PairTable& pairs);

  // Finds the overlaps of candidate pairs of rod edges on the lagged surfaces.
  void find(const Candidates& candidates, const LaggedSurface& held);

  const std::vector<Crossing>& crossings() const { return crossings_; }
  // Returns the overlap area of a rod vertex with the rods of another object [m^2].
  double area(int vertex, int object) const;

 private:
  struct Share {
    std::array<int, 2> key;  // vertex, object
    double area;
  };
  struct Found;
  bool closest_of_rod(int edge, const Vec3& opposite, double distance,
                      const LaggedSurface& held) const;
  double part_of_nearest(int edge, int opposite, double distance, const LaggedSurface& held) const;
  std::array<Vec3, 2> continued(int edge, const LaggedSurface& held) const;
  void add(int first, int second, const LaggedSurface& held, Found& found) const;

  const ContactSurface& surface_;
  const PairTable& pairs_;
  std::vector<char> is_rod_;  // per edge of the mesh; empty without rods
  double longest_overlap_ = 0;  // of two that cross [m]
  std::vector<Crossing> crossings_;
  std::vector<Share> shares_;  // by key
};

}  // namespace tack
