// Triangles divided until no edge is longer than asked: every long edge at its middle, alike in all
// its triangles, so that what was closed stays closed. The new vertices are sums of the old ones of
// the triangle, or edge, that they lie in, with weights that are multiples of powers of one half
// and add up to one exactly. The old vertices stay. Errors: InputError if that would take more than
// `most` new vertices.
#pragma once

#include <utility>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct RefinedSurface {
  // Per new vertex: old vertices, ascending, and their weights. Numbers of new vertices follow
  // those of the old ones.
  std::vector<std::vector<std::pair<int, double>>> added;
  std::vector<Triangle> triangles;  // oriented as the old ones that they are part of
};

constexpr int most_added_vertices = 1000000;

// edge_length [m].
RefinedSurface refine_surface(std::vector<Vec3> vertices, std::vector<Triangle> triangles,
                              double edge_length, int most = most_added_vertices);

}  // namespace tack
