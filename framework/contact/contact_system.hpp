// One contact pass for all laws: candidates of one broad phase, valid until a vertex leaves its fat
// AABB (broad_phase.hpp), and the active stencils of the current configuration. Each object is
// inflated by a radius of its own (pair_radii.hpp).
#pragma once

#include <memory>

#include "framework/contact/contact_set.hpp"
#include "framework/contact/integration_sides.hpp"
#include "framework/core/phase_clock.hpp"
#include "framework/core/step_participant.hpp"
#include "geometry/broad_phase/colliding_objects.hpp"
#include "geometry/broad_phase/inflation_radii.hpp"

namespace tack {

class BroadPhase;
class SurfaceOverlap;
class LaggedSurface;
class NarrowPhase;
class OverlapBoundaryForces;

class ContactSystem : public StepParticipant {
 public:
  ContactSystem(ContactSurface surface, PairTable pairs, CollidingObjects colliding,
                PhaseClock& clock);
  ~ContactSystem();

  // Sets the free vertices (non-zero): no force is computed between primitives without one. Empty:
  // every candidate has one.
  void set_free(std::vector<char> free);
  // Searches pairs within the rigid groups of these global vertices too, and within no other group.
  void enable_self_pairs(const std::vector<int>& vertices);
  void clear_caches() override;
  // Returns the pairs whose coarser side is the secondary side in the present step
  // (IntegrationSides::coarse_pairs). They are history variables.
  const IntegrationSides::Pairs& coarse_pairs() const;
  // Sets those of the last accepted step; none: unknown.
  void set_previous_coarse_pairs(std::optional<IntegrationSides::Pairs> pairs) {
    previous_coarse_pairs_ = std::move(pairs);
  }
  void load_history(const History& history) override;
  void commit(const VecX& x, History& history) const override;
  // Starts a time step at x: areas, orientations and secondary sides are lagged from x.
  void begin_step(const StepStart& start) override;
  // Overlaps of the surfaces in the present step, and the lagged surfaces.
  const SurfaceOverlap& overlap() const;
  const LaggedSurface& lagged_surface() const;
  // Keeps the secondary sides of these pairs (ascending) from the next step on.
  void keep_sides(IntegrationSides::Pairs pairs) { kept_sides_ = std::move(pairs); }
  // Appends the triangles that may come within range of a point of a triangle. t: global vertices;
  // inside: barycentric coordinates.
  void triangles_near(const Triangle& t, const Vec3& inside, std::vector<int>& out) const;
  // Makes x the current configuration: finds its active stencils.
  void move_to(const VecX& x) override;
  // Rebuilds the candidates if a pair outside them may touch between x and x + p.
  void cover(const VecX& x, const VecX& p);

  const ContactSet& contacts() const { return contacts_; }
  // Overlap-boundary forces of the present step.
  const OverlapBoundaryForces& overlap_boundary_forces() const;
  const Candidates& candidates() const;
  const ContactSurface& surface() const { return surface_; }
  const PairTable& pairs() const { return pairs_; }
  const CollidingObjects& colliding() const { return colliding_; }
  // Counts the changes of the candidates.
  long candidates_version() const { return candidates_version_; }
  int broad_phase_builds() const;
  double range() const { return range_; }
  // The largest displacement for which one search is efficient [m]: above it, the AABBs of
  // displaced primitives are mostly empty.
  double search_displacement_max() const { return search_displacement_max_; }
  SmallestGaps smallest_gaps(const VecX& x) const;

 private:
  bool update_candidates(const VecX& x, const VecX& p);

  ContactSurface surface_;
  PairTable pairs_;
  CollidingObjects colliding_;
  PhaseClock& clock_;
  double range_ = 0;                    // largest range of all laws [m]
  double search_displacement_max_ = 0;  // m
  double skin_ = 0;                     // Verlet skin of the candidates [m]
  InflationRadii radii_;
  std::unique_ptr<BroadPhase> broad_phase_;
  long candidates_version_ = 0;
  std::unique_ptr<NarrowPhase> narrow_phase_;
  std::optional<IntegrationSides::Pairs> previous_coarse_pairs_;
  IntegrationSides::Pairs kept_sides_;
  ContactSet contacts_;
};

}  // namespace tack
