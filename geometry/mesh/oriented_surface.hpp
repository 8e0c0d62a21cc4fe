// Surface of consistent orientation: enclosed volume and area vectors. With an origin o and corners
// a, b, c relative to o, the enclosed volume is the cubic polynomial
//     V(x) = 1/6 sum_t det(a, b, c):
// the volume of the interior of a closed surface, for any o; of the cone from o for an open one.
//
// The area vector of a vertex, its force under a unit pressure, is a third of the sum of those of
// its triangles:
//     N_v = 1/6 sum_{t with v} (b - a) x (c - a)
//         = dV/dv + 1/6 sum_{boundary edges u -> w with v} u x w.
// Area vectors of a closed surface are the gradient of V; along a boundary they are no gradient.
// Values are stored by edges, as the second derivative couples only their ends, a then b, with the
// opposite corners l, r (o for a missing one):
//     - 1/6 [l - r]_x.
// Other origins, or sums over triangles, yield far larger terms that cancel.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

class OrientedSurface {
 public:
  struct SurfaceEdge {
    int a, b;         // order in the triangle (a, b, left); the other one is (b, a, right)
    int left, right;  // right: -1 at a boundary
  };

  // triangles: with consistent orientation (consistently_oriented).
  explicit OrientedSurface(std::vector<Triangle> triangles);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<SurfaceEdge>& edges() const { return edges_; }
  bool closed() const { return closed_; }
  const std::vector<int>& vertices() const { return vertices_; }  // ascending

  double volume(const VecX& x, const Vec3& origin) const;
  double area(const VecX& x) const;
  // Adds factor times the area vectors of all vertices (3n) [m^2].
  void add_areas(const VecX& x, double factor, VecX& sum) const;
  // Returns the contribution of an edge to the area vectors of both ends: a sixth of its triangles.
  Vec3 edge_area_vector(const SurfaceEdge& e, const VecX& x) const;
  Vec3 mean_position(const VecX& x) const;  // mean over its vertices [m]

 private:
  std::vector<Triangle> triangles_;
  std::vector<SurfaceEdge> edges_;
  std::vector<int> vertices_;
  bool closed_ = true;
};

// Returns the triangles with consistent orientation; each connected component keeps the orientation
// of its first triangle. Throws InputError, without a source location, if there is none (a Moebius
// strip), or if an edge has more than two triangles.
std::vector<Triangle> consistently_oriented(std::vector<Triangle> triangles);

// Returns the connected component of each triangle, by edges, numbered from 0.
std::vector<int> components_by_edges(const std::vector<Triangle>& triangles);

// Returns the boundary loops of triangles of consistent orientation. Throws InputError, without a
// source location, where two loops meet in a vertex.
std::vector<std::vector<int>> boundary_loops(const std::vector<Triangle>& triangles);

// Returns triangles that close the slit between two loops: each vertex is joined to the nearest one
// of the other loop at x. Their orientation is arbitrary.
std::vector<Triangle> stitched(std::span<const int> first, std::span<const int> second,
                               const VecX& x);

}  // namespace tack
