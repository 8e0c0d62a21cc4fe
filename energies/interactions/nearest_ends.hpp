// Pairs of vertices that springs and ropes connect.
#pragma once

#include <string>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

// Returns each vertex of one list with its nearest vertex of another list, the first of equally
// near ones. rest: 3n [m]; who: "spring 'cord'". Throws InputError if both are one vertex.
std::vector<Edge> nearest_ends(const std::vector<int>& from, const std::vector<int>& to,
                               const VecX& rest, const std::string& who);

// Returns the length of a pair [m].
inline double length_of(const Edge& ends, const VecX& x) {
  return (vertex(x, ends[0]) - vertex(x, ends[1])).norm();
}

}  // namespace tack
