// Feasible cones of Offset Geometric Contact: the directions in which a point may lie from a vertex
// or an edge so that no other point of the adjacent faces is closer. With a face's half space they
// divide the space around a convex surface into one block per face, edge and vertex, and forces are
// orthogonal to the surface.
//     vertex v:  (x - v) . (v - n) >= 0  for all neighbours n
//     edge e:    (x - q) . (q - o) >= 0  for all opposite vertices o, with the foot q of o on e
// Over a concave edge or vertex no block remains, and blocks of faces overlap.
// Source: Chen et al. 2025, Offset Geometric Contact, ACM TOG 44(4): feasible regions of blocks.
#pragma once

#include "framework/contact/surface/surface_rings.hpp"

namespace tack {

// Largest cosine between a direction in a cone and a tangent: a flat surface has blocks of vertices
// and edges despite rounding errors.
inline constexpr double cone_cosine_max = 1e-9;

// Returns whether the direction d from a vertex lies in its cone, outside the body. x:
// configuration (3n) [m].
bool in_vertex_cone(const SurfaceRings& rings, const VecX& x, int vertex_index, const Vec3& d);

// Returns whether the direction d, orthogonal to an edge, lies in its cone, outside the body.
bool in_edge_cone(const SurfaceRings& rings, const CollisionMesh& mesh, const VecX& x, int edge,
                  const Vec3& d);

// Returns whether the direction d from an edge is in front of a triangle there; always true on a
// sheet.
bool outside_edge(const SurfaceRings& rings, const CollisionMesh& mesh, const VecX& x, int edge,
                  const Vec3& d);

}  // namespace tack
