#include "framework/stepping/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/stepping/time_integrator.hpp"

namespace tack {
namespace {

constexpr double ratio_target = 0.7;                      // target of r
constexpr double now_weight = 0.85, before_weight = 0.2;  // exponents of this and the last error, times p
constexpr double growth_max = 2, growth_min = 0.5;   // size of a step over that of the step before
constexpr double repetition_min = 0.1;               // size of a repetition over that of the step
constexpr double unchanged_min = 0.9, unchanged_max = 1.2;  // factors that are not worth a change of size
constexpr double ratio_min = 1e-4;                  // smaller ratios count as this one
constexpr double round_off = 1e-9;                      // relative

}  // namespace

StepControl::StepControl(const World& world, const TimeConfig& time) : time_(time), world_(world) {
  const auto add = [&](double t) {
    if (t > 0 && std::isfinite(t)) corners_.push_back(t);
  };
  for (const PrescribedMotion::Assignment& assignment : world.prescribed_motion.assignments()) {
    add(assignment.motion->from());
    add(assignment.motion->until());
    for (const double t : assignment.motion->corners()) add(t);
  }
  for (const TimedConstraint& timed : world.constraints.timed()) add(timed.from), add(timed.until);
  for (const double t : world.participants.abrupt_times()) add(t);
  add(time.duration);
  std::sort(corners_.begin(), corners_.end());
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    WeightedVertices body{world.vertices_of(static_cast<int>(i)), {}};
    double mass = 0;
    for (const int v : body.vertices) mass += world.gravitational_mass(v);
    for (const int v : body.vertices) body.weights.push_back(mass > 0 ? world.gravitational_mass(v) : world.is_scalar_dof(v) ? 0 : 1);
    bodies_.push_back(std::move(body));
  }
}

double StepControl::time_tolerance() const { return round_off * time_.step; }

double StepControl::stop_after(double t) const {
  const auto corner = std::upper_bound(corners_.begin(), corners_.end(), t + time_tolerance());
  double stop = corner == corners_.end() ? std::numeric_limits<double>::infinity() : *corner;
  if (!next_) return stop;
  const double due = next_(t);
  return due > t + time_tolerance() ? std::min(stop, due) : stop;
}

double StepControl::size(const State& state) const {
  double h = std::min(state.h_next, time_.largest_step());
  if (state.h_max > 0) h = std::min(h, state.h_max);
  const double left = stop_after(state.time) - state.time;
  if (left <= h * (1 + round_off) + time_tolerance()) return left;
  return left < 2 * h ? left / 2 : h;
}

double StepControl::measure(const TimeIntegrator& integrator, const State& state, const VecX& x, const VecX& contact, double h) {
  const TimeIntegrator::LocalError error = integrator.local_error(state, x, contact, h);
  double largest = 0;
  for (const WeightedVertices& body : bodies_) {
    double sum = 0, weights = 0;
    for (size_t i = 0; i < body.vertices.size(); ++i) {
      const int v = body.vertices[i];
      if (!world_.dofs.moves(v)) continue;
      sum += body.weights[i] * vertex(error.x, v).squaredNorm();
      weights += body.weights[i];
    }
    if (weights > 0) largest = std::max(largest, std::sqrt(sum / weights));
  }
  ratio_ = largest / time_.adaptive->error;
  power_ = error.power;
  return largest;
}

bool StepControl::repeats(State& state, double h) {
  if (!too_large() || h <= time_.smallest_step() * (1 + round_off)) return false;
  double power = power_;
  if (rejected_.step == state.step && rejected_.h > h * (1 + round_off))
    power = std::clamp(std::log(rejected_.ratio / ratio_) / std::log(rejected_.h / h), 1.0, power);
  rejected_ = {state.step, h, ratio_};
  state.h_next = std::max(h * std::clamp(std::pow(ratio_target / ratio_, 1 / power), repetition_min, unchanged_min), time_.smallest_step());
  state.no_growth_until = std::max(state.no_growth_until, state.time + h);
  return true;
}

void StepControl::accepted(State& state, double h) {
  const double now = std::max(ratio_, ratio_min), before = state.error_before > 0 ? state.error_before : ratio_target, planned = state.h_next;
  double factor = std::pow(ratio_target / now, now_weight / power_) * std::pow(before / ratio_target, before_weight / power_);
  factor = std::clamp(factor, growth_min, growth_max);
  if (factor > unchanged_min && factor < unchanged_max) factor = 1;
  if (factor > 1 && state.time < state.no_growth_until - time_tolerance()) factor = 1;
  state.error_before = now;
  state.h_next = h * factor;
  if (factor >= 1) state.h_next = std::max(state.h_next, planned);  // a step that ended at a corner was shortened
  state.h_next = std::clamp(state.h_next, time_.smallest_step(), time_.largest_step());
  if (state.h_max == 0 || ++state.steady_steps < steady_steps_min) return;
  state.steady_steps = 0;
  state.h_max *= 2;
  if (state.h_max >= time_.largest_step()) state.h_max = 0;
}

void StepControl::refined(State& state, double h, bool lasting) {
  state.no_growth_until = std::max(state.no_growth_until, state.time + h);
  if (!lasting) return;
  state.h_max = state.h_next;
  state.steady_steps = 0;
}

}  // namespace tack
