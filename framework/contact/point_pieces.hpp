// The quadrature points of a list of candidates, each with the triangles that it acts on: what
// carries pressure, piece by piece (facing_view.hpp; of rods and particles by shares,
// codimensional_view.hpp), and what is only guarded against. Made once per list of candidates, so
// that looking for active stencils only touches what can become one.
#pragma once

#include <vector>

#include "framework/contact/facing_view.hpp"
#include "framework/contact/integration_sides.hpp"
#include "framework/contact/pair_table.hpp"
#include "framework/contact/point_groups.hpp"
#include "framework/contact/rod_overlaps.hpp"
#include "framework/contact/weight_relaxation.hpp"
#include "framework/contact/codimensional_view.hpp"
#include "geometry/broad_phase/changed_primitives.hpp"

namespace tack {

struct PointPiece {
  int point;
  int law;
  double area;   // share of the point's area [m^2]
  double range;  // of the law [m]
  int triangle_begin, triangle_end;  // into PointPieces::triangles
  // Into PointPieces::shares, one per triangle; -1: all of them count in full.
  int share_begin;
  int edge_begin, edge_end;          // into PointPieces::edges
  int other_begin, other_end;        // into PointPieces::others
};

struct PointPieces {
  std::vector<PointPiece> pieces;
  std::vector<int> group_begin;  // into pieces, of each group; and the end
  std::vector<int> triangles;  // into Candidates::point_triangle
  std::vector<TriangleWeight> shares;
  std::vector<int> edges;      // of the mesh: rods
  std::vector<int> others;     // global vertices: particles
  LaggedWeights held;            // what the shares are in this step
};

// The view of a group, known for the step.
struct GroupView {
  int point, object;
  FacingView view;

  std::array<int, 2> key() const { return {point, object}; }
};

struct PieceRequest {
  const ContactSurface& surface;
  const PairTable& pairs;
  const LaggedSurface& held;
  const IntegrationSides& sides;
  const RodOverlaps& rods;
  const Candidates& candidates;
  const PointGroups& groups;
  // Views of the groups that existed when the step began, sorted by key.
  const std::vector<GroupView>& views;
  // Views of later groups, sorted by key. Every integrating group is in one of the two lists.
  const std::vector<GroupView>& later_views;
  const LaggedWeights& shares_before;           // of the step before
};
// Pieces made in this step from earlier candidates, and the changes since: all other groups keep
// their pieces.
struct EarlierPieces {
  const PointGroups& groups;
  const PointPieces& pieces;
  const ChangedPrimitives& changed;
};
// earlier: null: there is nothing.
PointPieces make_pieces(const PieceRequest& request, const EarlierPieces* earlier);
// Joins the pieces of all chunks of groups, in their order.
PointPieces joined_pieces(const std::vector<PointPieces>& chunks);

}  // namespace tack
