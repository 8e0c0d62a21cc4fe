#include "framework/contact/stencils/contact_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/contact/stencils/rest_neighbours.hpp"
#include "geometry/broad_phase/candidate_kinds.hpp"
#include "geometry/parallel.hpp"

namespace tack {

Candidates candidates_between(const CollisionMesh& mesh, const Candidates& candidates, int a, int b) {
  Candidates found;
  found.reference = candidates.reference;
  for_each_kind(mesh, candidates, [&](const auto& kind) {
    for (size_t k = 0; k < kind.pairs.size(); ++k) {
      const auto& pair = kind.pairs[k];
      const int i = mesh.vertex_object[kind.first(pair)[0]], j = mesh.vertex_object[kind.second(pair)[0]];
      if (!((i == a && j == b) || (i == b && j == a))) continue;
      (found.*kind.list).push_back(pair);
      (found.distance_bounds.*kind.lengths).push_back((candidates.distance_bounds.*kind.lengths)[k]);
      (found.reference_distances.*kind.lengths).push_back((candidates.reference_distances.*kind.lengths)[k]);
    }
  });
  return found;
}

SmallestGaps smallest_gaps(const ContactSurface& surface, const PairTable& pairs, const Candidates& candidates, const VecX& x) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const CollisionMesh& mesh = surface.mesh;
  SmallestGaps found{infinity, infinity};
  for_each_kind(mesh, candidates, [&](const auto& kind) {
    const std::vector<double>& bounds = candidates.distance_bounds.*kind.lengths;
    const int n = static_cast<int>(kind.pairs.size());
    std::vector<SmallestGaps> partial(chunk_count(n, chunk_size), found);  // begins with the smallest gaps so far
    for_each_chunk(n, [&](int c, int first, int last) {
      SmallestGaps& gaps = partial[c];
      for (int i = first; i < last; ++i) {
        const auto& a = kind.first(kind.pairs[i]);
        const auto& b = kind.second(kind.pairs[i]);
        const int object_a = mesh.vertex_object[a[0]], object_b = mesh.vertex_object[b[0]];
        double& smallest = object_a == object_b ? gaps.of_all : gaps.between_objects;
        double offset = pairs.largest_offset() > 0 ? pairs.offset(object_a, object_b) : 0;
        if (bounds[i] - offset >= smallest) continue;
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
  });
  return found;
}

}  // namespace tack
