// From candidates to active stencils.
// Candidates are grouped by (point, object), and each group is split into what carries pressure and
// what is guarded against (point_pieces.hpp), once per list of candidates; each piece is reduced to
// features together (point_features.hpp). Where a rim runs across a triangle, points inside it take
// part (surface_overlap.hpp). All areas and orientations are those of the start of the time step,
// or of the moment in it when a group first appears, and held for that step, so that its potential
// is one function.
#pragma once

#include "framework/contact/contact_set.hpp"
#include "framework/contact/point_pieces.hpp"
#include "framework/contact/overlap_boundary_forces.hpp"
#include "framework/contact/sample_pieces.hpp"

namespace tack {

// Per global vertex, or empty: all are free. What a fixed point is near may be a fixed vertex of a
// triangle that has others: its nearest feature changes between those that move and those that do
// not, so that these are left out only where no triangle has both.
struct FreeVertices {
  std::vector<char> free;
  std::vector<char> beside;  // free, or on an edge with one that is
};

// A candidate between two edges of the mesh.
struct EdgePair {
  int candidate = 0;
  std::array<int, 2> edges{};
  int law = -1;  // of the pair table

  const std::array<int, 2>& key() const { return edges; }
};

class NarrowPhase {
 public:
  // All must outlive the narrow phase. The candidates that it is given are those of the broad
  // phase.
  NarrowPhase(const ContactSurface& surface, const PairTable& pairs, const BroadPhase& broad_phase);

  // Takes a new list of candidates before a step is begun with it. changed: since the one before,
  // within a step.
  void take(const Candidates& candidates, const ChangedPrimitives* changed = nullptr);
  // The same within a step; x: the current configuration, which begins a step if none was begun.
  void set_candidates(const Candidates& candidates, const VecX& x);
  // Holds x: areas, orientations and integration sides are those of x from now on.
  void begin_step(const Candidates& candidates, const VecX& x);
  // IntegrationSides::turned, and those of the step before the next.
  const IntegrationSides::Pairs& turned_sides() const { return sides_.turned(); }
  void set_turned_before(std::optional<IntegrationSides::Pairs> turned) {
    sides_.set_before(std::move(turned));
  }
  // Lagged weights of rods and particles in this step, and in the step before the next one.
  const LaggedWeights& held_shares() const { return pieces_.held; }
  const LaggedWeights& shares_before() const { return shares_before_; }
  void set_shares_before(LaggedWeights shares) { shares_before_ = std::move(shares); }
  // Stencils that have no free vertex (non-zero) are left out, as their potential is constant;
  // empty: every candidate has one.
  void set_free(std::vector<char> free);
  // The stencils closer than their law's range.
  void find(const Candidates& candidates, const VecX& x, ContactSet& contacts);
  // Overlap and its boundary forces, both of this step.
  const OverlapBoundaryForces& overlap_boundary_forces() const { return overlap_boundary_forces_; }
  const SurfaceOverlap& overlap() const { return overlap_; }
  const LaggedSurface& held() const { return held_; }
  void hold_sides(IntegrationSides::Pairs pairs) { sides_.hold(std::move(pairs)); }

 private:
  bool may_integrate(const PointGroup& group) const;
  std::vector<PointGroup> unseen(const ChangedPrimitives* changed) const;
  std::vector<GroupView> look(const Candidates& candidates, const std::vector<PointGroup>& groups,
                              bool later) const;
  void make_lists(const Candidates& candidates, const EarlierPieces* earlier);
  void choose_edges(const Candidates& candidates, const ChangedPrimitives* changed);

  const ContactSurface& surface_;
  const PairTable& pairs_;
  LaggedSurface held_;
  IntegrationSides sides_;
  SurfaceOverlap overlap_;
  OverlapBoundaryForces overlap_boundary_forces_;
  const BroadPhase& broad_phase_;
  FreeVertices free_;
  PointGroups groups_;
  std::vector<GroupView> views_;        // of the start of this step, by key
  std::vector<GroupView> later_views_;  // of groups that came later, likewise
  PointPieces pieces_;
  SamplePieces sample_pieces_;    // of the samples of the overlap
  RodOverlaps rods_;              // of this step
  LaggedWeights shares_before_;     // of the step before the next
  LaggedWeights shares_at_start_;   // of the step before this one
  std::vector<EdgePair> edge_pairs_;  // that may press, in the order of candidates
};

}  // namespace tack
