// Ranges of elements of a collision mesh by object.
#pragma once

#include <array>
#include <numeric>
#include <vector>

#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

// Returns the index of the first element of each object, and the end. Elements are sorted by the
// object of their first vertex.
template <std::size_t N>
std::vector<int> first_of_objects(const CollisionMesh& mesh,
                                  const std::vector<std::array<int, N>>& elements) {
  std::vector<int> first(object_count(mesh) + 1, 0);
  for (const auto& e : elements) ++first[mesh.vertex_object[e[0]] + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

}  // namespace tack
