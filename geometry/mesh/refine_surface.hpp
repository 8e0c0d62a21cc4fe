// Division of triangles until no edge is longer than a given length. Every long edge is bisected in
// all its triangles, so that a closed surface stays closed. A new vertex is a weighted sum of the
// old vertices of the triangle or edge that it lies in; the weights are multiples of powers of one
// half, and their sum is exactly one. Old vertices stay.
#pragma once

#include <utility>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct RefinedSurface {
  // Per new vertex: old vertices, ascending, and their weights. Indices of new vertices follow
  // those of the old ones.
  std::vector<std::vector<std::pair<int, double>>> added;
  std::vector<Triangle> triangles;  // oriented as the old triangles
};

constexpr int most_added_vertices = 1000000;

// Returns the divided triangles. edge_length: largest edge length [m]. Throws InputError if that
// takes more than `most` new vertices.
RefinedSurface refine_surface(std::vector<Vec3> vertices, std::vector<Triangle> triangles,
                              double edge_length, int most = most_added_vertices);

}  // namespace tack
