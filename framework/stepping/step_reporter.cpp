#include "framework/stepping/step_reporter.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "framework/affine/orthogonality_term.hpp"
#include "framework/body/extent.hpp"
#include "framework/bond/bond_term.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/stepping/energy_advice.hpp"
#include "framework/world/energy_records.hpp"

namespace tack {

StepReporter::StepReporter(const World& world, const SceneConfig& scene, const TimeConfig& time, PhaseClock& clock, WarningFunction warn)
    : world_(world), scene_(scene), time_(time), clock_(clock), warn_(std::move(warn)) {}

void StepReporter::begin() {
  started_ = Clock::now();
  seconds_ = clock_.seconds();
  builds_ = builds();
  intersections_ = inverted_tets_ = 0;
}

void StepReporter::add(const Validation& validation) {
  intersections_ += validation.intersections;
  inverted_tets_ += validation.inverted_tets;
}

StepReport StepReporter::report(const State& state, const SolveResult& result, double h) const {
  StepReport r;
  r.step = state.step;
  r.time = state.time;
  r.step_size = h;
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
    const SmallestGaps gaps = world_.contact->smallest_gaps(state.x);
    r.min_distance = gaps.of_all;
    r.min_gap = gaps.between_objects;
  }
  r.intersections = intersections_;
  r.inverted_tets = inverted_tets_;
  r.energies = energies_by_term(world_, state);
  if (world_.affine) r.affine_strain = world_.affine->largest_strain(state.x);
  return r;
}

void StepReporter::end(StepReport& r, const State& state, const std::string& energy_growth, const LaggedImpulses* impulses) {
  if (!energy_growth.empty())
    warn_({WarningKind::energy_growth, fmt::format("{}: {}", energy_growth, r.flows.gained_by_areas() ? areas_advice : time_.integrator->energy_advice(true, r.flows.in_contact))});
  warn_of(r, impulses, state);
  r.broad_phase_builds = builds() - builds_;
  const PhaseClock::Seconds& now = clock_.seconds();
  for (int i = 0; i < phase_count; ++i) r.phases[i] = now[i] - seconds_[i];
  r.wall_seconds = std::chrono::duration<double>(Clock::now() - started_).count();
}

void StepReporter::warn(WarningKind kind, int step, double time, const std::string& text, const std::string& subject) const {
  warn_({kind, fmt::format("step {} at t = {:.6g} s: {}", step, time, text), subject});
}

void StepReporter::warn_of(const StepReport& r, const LaggedImpulses* impulses, const State& state) {
  const auto tell = [&](WarningKind kind, const std::string& text) { warn(kind, r.step, r.time, text); };
  if (r.affine_strain > tolerated_affine_strain && !std::exchange(warned_of_strain_, true))
    tell(WarningKind::affine_strain, fmt::format("an affine body is strained by {:.2g}, more than {:g}; raise body.stiffness", r.affine_strain, tolerated_affine_strain));
  warn_of_joints(state);
  if (r.error && *r.error > time_.adaptive->error)
    tell(WarningKind::step_error, fmt::format("its error is {:.3g} m, more than time.adaptive.error {:.3g} m, and it is the smallest that is allowed; "
                       "lower time.adaptive.smallest ({:.3g} s), or allow a larger error", *r.error, time_.adaptive->error, time_.smallest_step()));
  if (world_.bonds) warn_of_unbonded();
  if (impulses && impulses->difference()) {
    const LaggedImpulses::Difference& d = *impulses->difference();
    tell(WarningKind::friction_impulse, fmt::format("friction between '{}' and '{}'{} has acted as if they had pressed each other with {:.3g} N s so "
                       "far, where it was {:.3g} N s: its normal forces lag by a step; refine time.step, or iterate them "
                       "(contact.lagging: {{iterations: 20, until: 1e-3}})", world_.bodies[d.objects[0]].name, world_.bodies[d.objects[1]].name,
                       d.others > 0 ? fmt::format(" (and between {} other two)", d.others) : "", d.applied, d.normal));
  }
  if (!r.lag_converged)
    tell(WarningKind::lagged_friction, fmt::format("after {} lag iterations tangential forces still change by {:.2g} of the largest (contact.lagging.until: {:.2g})",
                       r.lag_iterations, r.friction_residual, *scene_.contact->lagging.until));
}

// Warns of errors of joints that a stiff potential enforces, e.g. joints between fixed bodies.
void StepReporter::warn_of_joints(const State& state) const {
  constexpr double tolerated = 1e-3;  // of the size of the object
  for (const Joint& joint : world_.constraints.joints()) {
    if (!joint.play) continue;
    const double play = joint.play(state.x), size = extent_of(world_.bodies[static_cast<size_t>(joint.bodies.front())], world_.rest).diagonal().norm();
    if (play > tolerated * size)
      warn(WarningKind::joint_play, state.step, state.time, fmt::format("joint '{}' has an error of {:.3g} m, {:.2g}% of its object's size; raise body.stiffness of what it joins, or load it less",
                       joint.name, play, 100 * play / size), joint.name);
  }
}

void StepReporter::warn_of_unbonded() const {
  for (const int rule : world_.bonds->unbonded())
    for (const AdhesionSummary& pair : world_.adhesion)
      if (const auto& [a, b] = pair.kinds.front(); world_.bonds->table().between(a, b, pair.region_pair) == rule)
        warn_({WarningKind::no_bonds, fmt::format("no bonds were made between {}: nothing of them lies opposite the other within {:.6g} m at the start; move them closer, raise "
                           "bond_distance, or let them bond when they meet (bond: on_contact)", pair.names(), world_.bonds->table().rules()[rule].distance)});
}

}  // namespace tack
