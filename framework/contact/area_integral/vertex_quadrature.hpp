// Quadrature points at vertices, for a list of candidates, each with the primitives it acts on. A
// point carries contact pressure on one patch (visible_patches.hpp), on triangles with weights
// (rods and particles, codimensional_weights.hpp), or has a safety barrier alone. The points are
// made once per list of candidates, so that the search for active stencils visits only primitives
// that may come within range.
#pragma once

#include <vector>

#include "framework/contact/area_integral/patches_by_vertex.hpp"
#include "framework/contact/area_integral/integration_sides.hpp"
#include "framework/contact/laws/pair_table.hpp"
#include "framework/contact/area_integral/rod_overlaps.hpp"
#include "framework/contact/area_integral/weight_relaxation.hpp"
#include "framework/contact/area_integral/codimensional_weights.hpp"
#include "geometry/broad_phase/changed_primitives.hpp"

namespace tack {

struct VertexQuadraturePoint {
  int point;  // global vertex
  int law;
  double area;                       // weight times tributary area [m^2]
  double range;                      // of the law [m]
  int triangle_begin, triangle_end;  // into VertexQuadrature::triangles
  // Into VertexQuadrature::weights, one per triangle; -1: all weights are 1.
  int weight_begin;
  int edge_begin, edge_end;    // into VertexQuadrature::edges
  int other_begin, other_end;  // into VertexQuadrature::others
  int contact_point = 0;       // one for all quadrature points of a group and a law
};

struct VertexQuadrature {
  std::vector<VertexQuadraturePoint> points;
  std::vector<int> group_begin;  // into points, of each group; and the end
  std::vector<int> triangles;    // into Candidates::point_triangle
  std::vector<TriangleWeight> weights;
  std::vector<int> edges;        // of the mesh: rods
  std::vector<int> others;       // global vertices: particles
  LaggedWeights lagged_weights;  // of rods and particles in this step
  int contact_point_count = 0;
};

struct VertexQuadratureRequest {
  const ContactSurface& surface;
  const PairTable& pairs;
  const IntegrationRules& rules;
  const LaggedSurface& lagged;
  const IntegrationSides& sides;
  const RodOverlaps& rods;
  const Candidates& candidates;
  // Patches of the groups of this step that integrate, and the index into them of each group of
  // the candidates; -1: it does not integrate.
  const std::vector<GroupPatches>& patches;
  const std::vector<int>& patches_of_group;
  const LaggedWeights& previous_weights;  // of the last step
};
// Quadrature of the list of candidates before in this step, and the primitives that changed since.
// Groups without changed primitives keep their points.
struct EarlierVertexQuadrature {
  const VertexQuadrature& quadrature;
  const ChangedPrimitives& changed;
};
// Replaces `all` by the quadrature points of all groups. earlier: null if there are none in this
// step; its quadrature is another one.
void make_vertex_quadrature(const VertexQuadratureRequest& request,
                            const EarlierVertexQuadrature* earlier, VertexQuadrature& all);
// Replaces `all` by the points of all chunks of groups, in their order.
void join(const std::vector<VertexQuadrature>& chunks, VertexQuadrature& all);

}  // namespace tack
