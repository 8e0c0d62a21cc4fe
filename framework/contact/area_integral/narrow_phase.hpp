// Narrow phase: from candidates to active stencils.
//  1. Candidates are in groups of (point, object) (point_groups.hpp).
//  2. Each group becomes quadrature points that carry contact pressure or a safety barrier
//     (vertex_quadrature.hpp), once per list of candidates.
//  3. Where an overlap boundary crosses a triangle, interior quadrature points are added
//     (surface_overlap.hpp).
//  4. Each quadrature point is reduced to features, at each configuration (point_features.hpp).
// Areas and orientations are those of the surfaces at the start of the step, also for groups that
// first appear within it, so that the potential of the step is one function.
#pragma once

#include "framework/contact/stencils/contact_set.hpp"
#include "framework/contact/stencils/stencil_search.hpp"
#include "framework/contact/area_integral/vertex_quadrature.hpp"
#include "framework/contact/area_integral/overlap_boundary_forces.hpp"
#include "framework/contact/area_integral/interior_patches.hpp"
#include "geometry/vertex_items.hpp"

namespace tack {

// Items of a search where few vertices move.
struct LocalItems {
  std::vector<int> points, edges, interior;      // quadrature points, edge pairs, interior points
  std::vector<RodOverlaps::Crossing> crossings;  // of rods
  std::vector<int> vertices;                     // of all of them, ascending
};

class NarrowPhase {
 public:
  // All arguments must outlive the narrow phase. Candidates passed to it are those of the broad
  // phase.
  // The lagged surface is set before every call of set_candidates and begin_step.
  NarrowPhase(const ContactSurface& surface, const PairTable& pairs, const IntegrationRules& rules,
              const LaggedSurface& lagged, const BroadPhase& broad_phase);

  // Chooses the edge pairs of a new list of candidates before a step begins. changed: the
  // primitives changed since the last list of the step; null: all may have.
  void prepare(const Candidates& candidates, const ChangedPrimitives* changed = nullptr);
  // Sets a new list of candidates within a step, or begins the first step.
  void set_candidates(const Candidates& candidates);
  // Begins a step with the lagged surface: areas, orientations and secondary sides are those of it.
  void begin_step(const Candidates& candidates);
  // See IntegrationSides::coarse_pairs and set_previous.
  const IntegrationSides::Pairs& coarse_pairs() const { return sides_.coarse_pairs(); }
  void set_previous_coarse_pairs(std::optional<IntegrationSides::Pairs> pairs) {
    sides_.set_previous(std::move(pairs));
  }
  // Lagged weights of rods and particles: of this step, and of the last accepted step.
  const LaggedWeights& lagged_weights() const { return quadrature_.lagged_weights; }
  const LaggedWeights& previous_weights() const { return previous_weights_; }
  void set_previous_weights(LaggedWeights weights) { previous_weights_ = std::move(weights); }
  // Sets the free vertices (non-zero). Stencils without a free vertex are left out, as their
  // potential is constant. Empty: every candidate has a free vertex.
  void set_free(std::vector<char> free) { free_ = {surface_.mesh, std::move(free)}; }
  // Finds the stencils closer than the range of their law.
  void find(const Candidates& candidates, const VecX& x, ContactSet& contacts);
  // Returns what the search looks at where these vertices alone move, and searches it. Valid until
  // the candidates change or a step begins.
  LocalItems touching(const Candidates& candidates, std::span<const int> moved);
  void find(const LocalItems& items, const Candidates& candidates, const VecX& x,
            ContactSet& contacts) const;
  // Overlaps and overlap-boundary forces of this step.
  const OverlapBoundaryForces& overlap_boundary_forces() const { return overlap_boundary_forces_; }
  const SurfaceOverlap& overlap() const { return overlap_; }
  void keep_sides(IntegrationSides::Pairs pairs) { sides_.keep(std::move(pairs)); }

 private:
  bool may_integrate(const PointGroup& group) const;
  void look_up_patches(const std::vector<PointGroup>& groups);
  void add_patches(const Candidates& candidates, bool later);
  void make_lists(const Candidates& candidates, const EarlierVertexQuadrature* earlier);

  const ContactSurface& surface_;
  const PairTable& pairs_;
  const IntegrationRules& rules_;
  const LaggedSurface& lagged_;
  bool begun_ = false;
  IntegrationSides sides_;
  SurfaceOverlap overlap_;
  OverlapBoundaryForces overlap_boundary_forces_;
  const BroadPhase& broad_phase_;
  FreeVertices free_;
  // Patches of the groups of this step that integrate: by key those of its first candidates, then
  // those that each later list of candidates adds.
  std::vector<GroupPatches> patches_;
  struct PatchesOf {
    std::array<int, 2> group;
    int patches;  // index
    const std::array<int, 2>& key() const { return group; }
  };
  std::vector<PatchesOf> patch_index_;  // by key
  std::vector<int> patches_of_group_;   // per group of the candidates: index of its patches, or -1
  VertexQuadrature quadrature_;
  VertexQuadrature earlier_quadrature_;  // memory for the next one
  InteriorPatches interior_patches_;     // of the samples of the overlap
  EdgePairs edges_;
  RodOverlaps rods_;  // of this step
  // Items by vertex, made for touching().
  struct ItemMaps {
    VertexItems points, edges, interior;
    size_t interior_points;  // that the maps are for
  };
  template <class Act>
  void for_each_vertex(const Candidates& candidates, int point, const Act& act) const;
  template <class Act>
  void for_each_vertex_of_interior(int point, const Act& act) const;

  std::optional<ItemMaps> item_maps_;
  LaggedWeights previous_weights_;  // of the step before the next
  LaggedWeights weights_at_start_;  // of the step before this one
};

}  // namespace tack
