#include "framework/contact/contact_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/contact/rest_neighbours.hpp"
#include "geometry/parallel.hpp"

namespace tack {

Candidates candidates_between(const CollisionMesh& mesh, const Candidates& candidates, int a, int b) {
  Candidates found;
  found.reference = candidates.reference;
  const auto copy_pairs = [&](auto list, auto lengths, const auto& first_of, const auto& second_of) {
    for (size_t k = 0; k < (candidates.*list).size(); ++k) {
      const auto& pair = (candidates.*list)[k];
      const int i = mesh.vertex_object[first_of(pair[0])], j = mesh.vertex_object[second_of(pair[1])];
      if (!((i == a && j == b) || (i == b && j == a))) continue;
      (found.*list).push_back(pair);
      (found.distance_bounds.*lengths).push_back((candidates.distance_bounds.*lengths)[k]);
      (found.reference_distances.*lengths).push_back((candidates.reference_distances.*lengths)[k]);
    }
  };
  const auto self = [](int v) { return v; };
  const auto edge = [&](int e) { return mesh.edges[e][0]; };
  const auto triangle = [&](int t) { return mesh.triangles[t][0]; };
  copy_pairs(&Candidates::point_triangle, &CandidateLengths::point_triangle, self, triangle);
  copy_pairs(&Candidates::edge_edge, &CandidateLengths::edge_edge, edge, edge);
  copy_pairs(&Candidates::point_edge, &CandidateLengths::point_edge, self, edge);
  copy_pairs(&Candidates::point_point, &CandidateLengths::point_point, self, self);
  return found;
}

SmallestGaps smallest_gaps(const ContactSurface& surface, const PairTable& pairs, const Candidates& candidates, const VecX& x) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const CollisionMesh& mesh = surface.mesh;
  SmallestGaps found{infinity, infinity};
  const auto visit = [&](const auto& list, const auto& lengths, const auto& first_of, const auto& second_of) {
    const int n = static_cast<int>(list.size());
    std::vector<SmallestGaps> partial(chunk_count(n, chunk_size), found);  // begins with the smallest gaps so far
    for_each_chunk(n, [&](int c, int first, int last) {
      SmallestGaps& gaps = partial[c];
      for (int i = first; i < last; ++i) {
        const auto& a = first_of(list[i][0]);
        const auto& b = second_of(list[i][1]);
        const int object_a = mesh.vertex_object[a[0]], object_b = mesh.vertex_object[b[0]];
        double& smallest = object_a == object_b ? gaps.of_all : gaps.between_objects;
        double offset = pairs.largest_offset() > 0 ? pairs.offset(object_a, object_b) : 0;
        if (lengths[i] - offset >= smallest) continue;
        const double squared = squared_distance(corners(x, a), corners(x, b)), wanted = smallest + offset;
        if (wanted > 0 && squared >= wanted * wanted) continue;
        const double distance = std::sqrt(squared);
        if (offset > 0 && distance - offset < smallest) offset = offset_between(surface, pairs, a, b);
        smallest = std::min(smallest, distance - offset);
      }
    });
    for (const SmallestGaps& gaps : partial) {
      found.of_all = std::min({found.of_all, gaps.of_all, gaps.between_objects});
      found.between_objects = std::min(found.between_objects, gaps.between_objects);
    }
  };
  const auto point = [](int v) { return std::array{v}; };
  const auto edge = [&](int e) -> const Edge& { return mesh.edges[e]; };
  const auto triangle = [&](int t) -> const Triangle& { return mesh.triangles[t]; };
  const CandidateLengths& distance_bounds = candidates.distance_bounds;
  visit(candidates.point_triangle, distance_bounds.point_triangle, point, triangle);
  visit(candidates.edge_edge, distance_bounds.edge_edge, edge, edge);
  visit(candidates.point_edge, distance_bounds.point_edge, point, edge);
  visit(candidates.point_point, distance_bounds.point_point, point, point);
  return found;
}

}  // namespace tack
