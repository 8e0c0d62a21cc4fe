// Report of accepted steps: metrics and warnings.
#include <fmt/format.h>

#include <limits>
#include <utility>

#include "framework/affine/orthogonality_term.hpp"
#include "framework/body/extent.hpp"
#include "framework/bond/bond_term.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/stepping/energy_advice.hpp"
#include "framework/stepping/time_stepper.hpp"
#include "framework/world/energy_records.hpp"

namespace tack {

StepReport TimeStepper::report(const SolveResult& result, double h) const {
  StepReport r;
  r.step = state_.step;
  r.time = state_.time;
  r.step_size = h;
  r.cutbacks = cutbacks_;
  r.repeats = repeats_;
  if (control_) r.error = error_;
  r.solve = result.minimizer;
  r.converged = result.minimizer.status == MinimizerStatus::converged;
  r.unbalanced_force = result.unbalanced_force;
  r.tolerated_force = result.tolerated_force;
  r.lag_iterations = result.lag_iterations;
  r.friction_residual = result.friction_residual;
  r.lag_converged = result.lag_converged;
  r.metrics = result.metrics;
  r.min_distance = r.min_gap = std::numeric_limits<double>::infinity();
  if (world_.contact) {
    r.contacts = world_.contact->potential().active_count();
    r.candidates = static_cast<int>(world_.contact->candidates().size());
    const SmallestGaps gaps = world_.contact->smallest_gaps(state_.x);
    r.min_distance = gaps.of_all;
    r.min_gap = gaps.between_objects;
  }
  r.intersections = counts_.intersections;
  r.inverted_tets = counts_.inverted_tets;
  r.energies = energies_by_term(world_, state_);
  if (world_.affine) r.affine_strain = world_.affine->largest_strain(state_.x);
  return r;
}

// Warns of errors of joints that a stiff potential enforces, e.g. joints between fixed bodies.
void TimeStepper::warn_of_joints() {
  constexpr double tolerated = 1e-3;  // of the size of the object
  for (const Joint& joint : world_.constraints.joints()) {
    if (!joint.play) continue;
    const double play = joint.play(state_.x), size = extent_of(world_.bodies[static_cast<size_t>(joint.bodies.front())], world_.rest).diagonal().norm();
    if (play > tolerated * size)
      warn_({WarningKind::joint_play, fmt::format("step {} at t = {:.6g} s: joint '{}' has an error of {:.3g} m, {:.2g}% of its object's size; raise body.stiffness of what it joins, or load it less",
                         state_.step, state_.time, joint.name, play, 100 * play / size), joint.name});
  }
}

void TimeStepper::warn_of(const SolveResult& result, const StepReport& r) {
  if (!balance_.warning().empty())
    warn_({WarningKind::energy_growth, fmt::format("{}: {}", balance_.warning(),
                       r.flows.gained_by_areas() ? areas_advice : time_.integrator->energy_advice(true, r.flows.in_contact))});
  if (r.affine_strain > tolerated_affine_strain && !std::exchange(warned_of_strain_, true))
    warn_({WarningKind::affine_strain, fmt::format("step {} at t = {:.6g} s: an affine body is strained by {:.2g}, more than {:g}; raise body.stiffness",
                       state_.step, state_.time, r.affine_strain, tolerated_affine_strain)});
  warn_of_joints();
  if (control_ && control_->too_large())
    warn_({WarningKind::step_error, fmt::format("step {} at t = {:.6g} s: its error is {:.3g} m, more than time.adaptive.error {:.3g} m, and it is the smallest that is allowed; "
                       "lower time.adaptive.smallest ({:.3g} s), or allow a larger error",
                       state_.step, state_.time, *r.error, time_.adaptive->error, time_.smallest_step())});
  if (world_.bonds) warn_of_unbonded();
  if (impulses_ && impulses_->difference()) {
    const LaggedImpulses::Difference& d = *impulses_->difference();
    warn_({WarningKind::friction_impulse, fmt::format("step {} at t = {:.6g} s: friction between '{}' and '{}'{} has acted as if they had pressed each other with {:.3g} N s so "
                       "far, where it was {:.3g} N s: its normal forces lag by a step; refine time.step, or iterate them "
                       "(contact.lagging: {{iterations: 20, until: 1e-3}})",
                       state_.step, state_.time, world_.bodies[d.objects[0]].name, world_.bodies[d.objects[1]].name,
                       d.others > 0 ? fmt::format(" (and between {} other two)", d.others) : "", d.applied, d.normal)});
  }
  if (!result.lag_converged)
    warn_({WarningKind::lagged_friction, fmt::format("step {} at t = {:.6g} s: after {} lag iterations tangential forces still change by "
                       "{:.2g} of the largest (contact.lagging.until: {:.2g})",
                       state_.step, state_.time, result.lag_iterations, result.friction_residual,
                       *scene_.contact->lagging.until)});
}

void TimeStepper::warn_of_unbonded() {
  for (const int rule : world_.bonds->unbonded())
    for (const AdhesionSummary& pair : world_.adhesion)
      if (const auto& [a, b] = pair.kinds.front(); world_.bonds->table().between(a, b, pair.region_pair) == rule)
        warn_({WarningKind::no_bonds, fmt::format("no bonds were made between {}: nothing of them lies opposite the other within {:.6g} m at the start; move them closer, raise "
                           "bond_distance, or let them bond when they meet (bond: on_contact)", pair.names(), world_.bonds->table().rules()[rule].distance)});
}

}  // namespace tack
