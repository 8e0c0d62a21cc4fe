// Overlap areas of rods at the start of a step: the common area of the projections of two rod edges
// along their shortest connection. Each projection is a rectangle, as long as the edge and as wide
// as the rod. Sums over edges do not depend on the meshes:
//   crossing rods   the parallelogram w_1 w_2 / sin(theta)
//   parallel rods   the length over which they lie side by side times the smaller width
// Crossing rods carry the area by the pair of edges with the closest points, because elsewhere in
// the parallelogram the distance of the axes is larger than that of the rods. Nearly parallel rods
// have no unique closest points: the vertices of both carry half of the area each. In between, the
// pair of edges and the vertices share the area.
#pragma once

#include <array>
#include <vector>

#include "framework/contact/surface/lagged_surface.hpp"
#include "framework/contact/laws/pair_table.hpp"

namespace tack {

// Returns the common area [m^2] of two rectangles that are projected along the unit vector n. Their
// axes are the segments a and b, their widths width_a and width_b [m]. centre: set to the centroid
// of the common area, if there is one.
double projected_overlap(const std::array<Vec3, 2>& a, double width_a, const std::array<Vec3, 2>& b,
                         double width_b, const Vec3& n, Vec3& centre);
// Returns the common area of a disc and a strip whose axis runs through its centre [m^2].
double disc_overlap(double radius, double width);

class RodOverlaps {
 public:
  struct Crossing {
    std::array<int, 2> edges;  // of the mesh
    double area;               // m^2
  };

  RodOverlaps(const ContactSurface& surface, const PairTable& pairs);

  // Finds the overlaps of candidate pairs of rod edges on the lagged surfaces.
  void find(const Candidates& candidates, const LaggedSurface& lagged);

  const std::vector<Crossing>& crossings() const { return crossings_; }
  // Returns the overlap area of a rod vertex with the rods of another object [m^2].
  double area(int vertex, int object) const;

 private:
  struct VertexArea {
    std::array<int, 2> key;  // vertex, object
    double area;
  };
  struct ChunkOverlaps;
  bool closest_of_rod(int edge, const Vec3& opposite, double distance,
                      const LaggedSurface& lagged) const;
  double nearest_edge_fraction(int edge, int opposite, double distance,
                               const LaggedSurface& lagged) const;
  std::array<Vec3, 2> extended(int edge, const LaggedSurface& lagged) const;
  void add(int first, int second, const LaggedSurface& lagged, ChunkOverlaps& found) const;

  const ContactSurface& surface_;
  const PairTable& pairs_;
  std::vector<char> is_rod_;    // per edge of the mesh; empty without rods
  double longest_overlap_ = 0;  // of crossing rods [m]
  std::vector<Crossing> crossings_;
  std::vector<VertexArea> vertex_areas_;  // by key
};

}  // namespace tack
