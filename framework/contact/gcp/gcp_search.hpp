// Search for the stencils of the Geometric Contact Potential at one configuration: all pairs of
// vertices, vertices and edges, vertices and faces, and edges that are closer than their range,
// with closest points inside both primitives and no factor equal to 0.
//
// Quadrature weights. A vertex stands for a third of its triangles, a_v; an edge for a third of its
// triangles, a_e (areas at rest).
//     vertex-face, vertex-edge: a_v / 4    vertex-vertex: (a_v + a_w) / 4    edges: sqrt(a_e a_f) /
//     4
// Over two flat surfaces, vertices of both sides count the area twice, and so do crossing edges
// (2.0 times the area on right-angled grids, 2.2 on equilateral ones): together once.
// Difference: the paper multiplies the measures of both primitives, L^(4 - dim g - dim h) A_g A_h
// [m^4], with a barrier of 1/m^2. The pressure at a gap then falls with the square of the edge
// length. Laws of this project are energies per area, and so are the weights.
//
// Range at rest. Within one object the range of a primitive is at most half of its gap at rest to
// any other one with which it has a stencil, so that an object alone is free of forces (paper,
// adaptive localization). Each pair has the smaller range of both primitives.
#pragma once

#include "framework/contact/gcp/gcp_stencil.hpp"
#include "framework/contact/surface/surface_rings.hpp"

namespace tack {

// Ranges of primitives of an object within itself [m]; infinite without a limit.
struct GcpRestRanges {
  std::vector<double> of_vertex, of_edge, of_triangle;
};

struct GcpSearchRequest {
  const ContactSurface& surface;
  const SurfaceRings& rings;
  const PairTable& pairs;
  const GcpSmoothing& smoothing;
  const GcpRestRanges& rest;
  const std::vector<char>& free;  // per global vertex; empty: every vertex is free
};

// Returns the stencils at x (3n) [m].
GcpStencils find_gcp_stencils(const GcpSearchRequest& request, const Candidates& candidates,
                              const VecX& x);

// Returns the ranges at rest, from the stencils of each object with itself at rest.
GcpRestRanges gcp_rest_ranges(const ContactSurface& surface, const SurfaceRings& rings,
                              const PairTable& pairs, const GcpSmoothing& smoothing);

// Sets the positions of a stencil's vertices.
void gcp_positions(const VecX& x, std::span<const int> vertices,
                   std::array<Vec3, gcp_arity_max>& out);

}  // namespace tack
