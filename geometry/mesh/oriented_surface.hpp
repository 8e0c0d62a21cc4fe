// Triangles that are oriented alike, and what they enclose. With an origin o and corners a, b, c less o
//     V(x) = 1/6 sum_t det(a, b, c),
// a cubic polynomial: the volume within a closed surface, whatever o is, and of an open one that of the cone from o. Of what acts along the
// normals with a traction of 1, its areas, a vertex has a third of each of its triangles:
//     N_v = 1/6 sum_{t with v} (b - a) x (c - a)   = dV/dv + 1/6 sum_{boundary edges u -> w with v} u x w.
// Closed, the areas are the gradient of V. Along a boundary they are no gradient, as what leans on it encloses nothing.
// Everything is stored by edges, as the second derivative couples their ends alone: by a, then b, with the corners l, r opposite (o in the
// place of one that is missing)
//     - 1/6 [l - r]_x,
// which other origins or sums over triangles would make of parts that are far larger and cancel.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

class OrientedSurface {
 public:
  struct SurfaceEdge {
    int a, b;   // as in the triangle (a, b, left); the other is (b, a, right)
    int left, right;  // right: -1 at a boundary
  };

  // Of one orientation throughout (oriented_alike).
  explicit OrientedSurface(std::vector<Triangle> triangles);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<SurfaceEdge>& edges() const { return edges_; }
  bool closed() const { return closed_; }
  const std::vector<int>& vertices() const { return vertices_; }  // ascending

  double volume(const VecX& x, const Vec3& origin) const;
  double area(const VecX& x) const;
  // Adds factor times the areas of all vertices (3n) [m^2].
  void add_areas(const VecX& x, double factor, VecX& sum) const;
  // What an edge has of the areas of either end: half of its triangles, of each a third.
  Vec3 share(const SurfaceEdge& e, const VecX& x) const;
  Vec3 mean_place(const VecX& x) const;  // of its vertices

 private:
  std::vector<Triangle> triangles_;
  std::vector<SurfaceEdge> edges_;
  std::vector<int> vertices_;
  bool closed_ = true;
};

// The same triangles, turned so that neighbours are oriented alike; what hangs together keeps the orientation of its first one. Throws InputError,
// without a place, if there is none (a Moebius strip), or if an edge has more than two triangles.
std::vector<Triangle> oriented_alike(std::vector<Triangle> triangles);

// What hangs together by edges: the number of its part for each triangle, from 0.
std::vector<int> parts_of(const std::vector<Triangle>& triangles);

// The boundaries of triangles that are oriented alike, each once around. Throws InputError, without a place, where two of them meet in a vertex.
std::vector<std::vector<int>> boundary_loops(const std::vector<Triangle>& triangles);

// Triangles that close the slit between two loops, from each vertex of one to what is nearest of the other, at x; of any orientation.
std::vector<Triangle> stitched(std::span<const int> first, std::span<const int> second, const VecX& x);

}  // namespace tack
