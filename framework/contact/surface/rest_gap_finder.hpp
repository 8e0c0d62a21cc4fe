// Finds the gaps between primitives of one object at rest (rest_gaps.hpp).
#pragma once

#include <array>
#include <vector>

#include "framework/contact/surface/visible_patches.hpp"
#include "framework/contact/laws/pair_table.hpp"
#include "geometry/broad_phase/candidates.hpp"

namespace tack {

// All objects at rest, shared by all finders.
struct RestShape {
  // search_radius: per object, the largest distance of a gap to itself [m].
  RestShape(const ContactSurface& surface, const PairTable& pairs,
            const std::vector<double>& search_radius);

  const ContactSurface& surface;
  const PairTable& pairs;
  const std::vector<double>& search_radius;
  LaggedSurface lagged;
  std::vector<int> start,
      neighbours;  // CSR lists of the vertices on an edge with each global vertex
};

// Finder of one thread, with its own buffers.
class RestGapFinder {
 public:
  RestGapFinder(const RestShape& shape, const Candidates& candidates);

  // Returns the smallest distance at rest of a vertex to its own object below which it presses [m];
  // infinity: there is none. Appends the pairs with a gap between them to `gaps`.
  double of_point(const PointGroup& group, std::vector<std::array<int, 4>>& gaps);
  // Returns the distance at rest of an edge-edge candidate below which it presses [m]; infinity:
  // there is no gap. Appends the pair to `gaps` if there is one. Candidates must ascend.
  double of_edges(int candidate, std::vector<std::array<int, 4>>& gaps);

 private:
  double sine_from(int triangle, const Vec3& foot, const Vec3& to) const;
  double sine_from(const Edge& edge, const Vec3& foot, const Vec3& to) const;
  bool lies_over(int point, int triangle) const;
  bool lies_over(int point, const Edge& rod) const;
  bool lie_over(const Edge& a, const Edge& b) const;
  template <std::size_t A>
  void find_paths_from(const std::array<int, A>& sources, double length);
  template <std::size_t B>
  bool is_far(const std::array<int, B>& vertices, double distance) const;

  const RestShape& shape_;
  const CollisionMesh& mesh_;
  const VecX& x_;
  const Candidates& candidates_;
  PatchFinder finder_;
  // Path length over the mesh from the sources, per global vertex [m]; infinity: not reached.
  std::vector<double> path_length_;
  std::vector<int> reached_;                  // vertices with a finite path length
  std::vector<std::pair<double, int>> open_;  // a heap
  std::array<int, 2> path_source_{-1, -1};    // the edge walked from last
};

}  // namespace tack
