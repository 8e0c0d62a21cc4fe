// Displacement bounds of Offset Geometric Contact: how far each vertex may move, in any direction
// and together with all others, without surfaces passing through each other:
//     b_v = gamma min(r_q, d_v, min over triangles t at v of d_t, min over edges e at v of d_e),
// with the distances d of vertices to triangles, triangles to vertices and edges to edges that they
// share no vertex with, and the search radius r_q. gamma < 1/2: both sides may move.
// Source: Chen et al. 2025, Offset Geometric Contact, ACM TOG 44(4), conservative displacement
// bounds.
//
// The model `ogc` does not truncate displacements: one continuous collision detection per line
// search gives the largest step along a Newton direction, which the bounds would change to another
// direction without descent. The bounds are the test of the search: no motion within them may
// touch.
#pragma once

#include <vector>

#include "geometry/broad_phase/candidates.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

// candidates: all pairs closer than the search radius at x (3n) [m]. Returns a bound for each
// global vertex [m]; infinity for vertices of no surface.
std::vector<double> displacement_bounds(const CollisionMesh& mesh, const Candidates& candidates,
                                        const VecX& x, double search_radius, double gamma = 0.45);

}  // namespace tack
