// Finds the gaps between primitives of one object at rest (rest_gaps.hpp).
#pragma once

#include <array>
#include <vector>

#include "framework/contact/facing_view.hpp"
#include "framework/contact/pair_table.hpp"
#include "framework/contact/point_groups.hpp"

namespace tack {

// All objects at rest, for all finders.
struct RestShape {
  // reach: per object, how close to itself it is of interest [m].
  RestShape(const ContactSurface& surface, const PairTable& pairs,
            const std::vector<double>& reach);

  const ContactSurface& surface;
  const PairTable& pairs;
  const std::vector<double>& reach;
  LaggedSurface held;
  std::vector<int> start, beside;  // the vertices on an edge with each global vertex
};

// Finder of one thread, with its own buffers.
class RestGapFinder {
 public:
  RestGapFinder(const RestShape& shape, const Candidates& candidates);

  // Returns the smallest distance at rest of a vertex to its own object, from which on it presses
  // [m]; infinity: there is none. Appends the pairs with a gap between them to `gaps`.
  double of_point(const PointGroup& group, std::vector<std::array<int, 4>>& gaps);
  // Returns the distance at rest of a candidate between two edges, from which on it presses [m];
  // infinity: there is no gap. Appends the pair to `gaps` if there is one. Candidates come in
  // ascending order.
  double of_edges(int candidate, std::vector<std::array<int, 4>>& gaps);

 private:
  double sine_from(int triangle, const Vec3& foot, const Vec3& to) const;
  double sine_from(const Edge& edge, const Vec3& foot, const Vec3& to) const;
  bool lies_over(int point, int triangle) const;
  bool lies_over(int point, const Edge& rod) const;
  bool lie_over(const Edge& a, const Edge& b) const;
  template <std::size_t A>
  void walk_from(const std::array<int, A>& sources, double length);
  template <std::size_t B>
  bool is_far(const std::array<int, B>& vertices, double distance) const;

  const RestShape& shape_;
  const CollisionMesh& mesh_;
  const VecX& x_;
  const Candidates& candidates_;
  FacingViewer viewer_;
  // Path length over the mesh from the sources, per global vertex [m]; infinity: not reached.
  std::vector<double> way_;
  std::vector<int> reached_;                  // vertices with a finite path length
  std::vector<std::pair<double, int>> open_;  // a heap
  std::array<int, 2> walked_{-1, -1};         // the edge walked from last
};

}  // namespace tack
