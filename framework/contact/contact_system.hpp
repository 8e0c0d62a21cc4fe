// Contact system of a world: the search for close pairs, which all contact models share. It has the
// contact surfaces, the laws of pairs of objects, the candidates of one broad phase, valid until a
// vertex leaves its fat AABB (broad_phase.hpp), and the surfaces at the start of the step. Each
// object is inflated by a radius of its own (pair_radii.hpp). The contact potential
// (contact_potential.hpp) makes active stencils of the candidates.
#pragma once

#include <memory>
#include <span>

#include "framework/contact/stencils/contact_set.hpp"
#include "framework/contact/surface/lagged_surface.hpp"
#include "framework/core/phase_clock.hpp"
#include "framework/core/step_participant.hpp"
#include "geometry/broad_phase/colliding_objects.hpp"
#include "geometry/broad_phase/inflation_radii.hpp"

namespace tack {

class BroadPhase;
class ContactPotential;

class ContactSystem : public StepParticipant {
 public:
  ContactSystem(ContactSurface surface, PairTable pairs, CollidingObjects colliding,
                PhaseClock& clock, std::unique_ptr<ContactPotential> potential);
  ~ContactSystem();

  ContactPotential& potential() { return *potential_; }
  const ContactPotential& potential() const { return *potential_; }

  // Sets the free vertices (non-zero): no force is computed between primitives without one. Empty:
  // every candidate has one.
  void set_free(std::vector<char> free);
  void clear_caches() override;
  void load_history(const History& history) override;
  void commit(const VecX& x, History& history) const override;
  // Starts a time step at x: areas and orientations are lagged from x.
  void begin_step(const StepStart& start) override;
  // The surfaces at the start of the step.
  const LaggedSurface& lagged_surface() const { return lagged_; }
  // Appends the triangles that may come within range of a point of a triangle. t: global vertices;
  // inside: barycentric coordinates.
  void triangles_near(const Triangle& t, const Vec3& inside, std::vector<int>& out) const;
  // Makes x the current configuration: finds its active stencils.
  void move_to(const VecX& x) override;
  // Returns the current configuration (3n) [m]. Throws logic_error before the first one of a step.
  const VecX& configuration() const;
  // Throws logic_error if x is not the current configuration, to rounding.
  void require_at(const VecX& x) const;
  // Calls act() at the configuration x, then returns to the current one. If act throws, the system
  // stays at x.
  template <class Act>
  void at(const VecX& x, const Act& act) {
    const VecX before = configuration_;
    if (!is_at(x)) move_to(x);
    act();
    if (before.size() > 0 && !is_at(before)) move_to(before);
  }
  // Returns whether the candidates are valid as far as these vertices are concerned.
  bool covers(const VecX& x, std::span<const int> vertices) const;
  // Whether they are, once more, with a vertex at this position [m].
  bool covers_displaced(int vertex, const Vec3& position) const;
  // Rebuilds the candidates if a pair outside them may touch between x and x + p.
  void cover(const VecX& x, const VecX& p);

  const ContactSet& contacts() const { return contacts_; }
  const Candidates& candidates() const;
  const BroadPhase& broad_phase() const { return *broad_phase_; }
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
  bool is_at(const VecX& x) const {
    return x.size() == configuration_.size() && x == configuration_;
  }
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
  long checked_version_ = -1;  // of the candidates whose stencils were seen to be sorted
  LaggedSurface lagged_;
  ContactSet contacts_;
  VecX configuration_;  // of the active stencils; empty: areas have changed since
  std::unique_ptr<ContactPotential> potential_;
};

}  // namespace tack
