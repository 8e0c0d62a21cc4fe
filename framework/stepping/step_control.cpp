#include "framework/stepping/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/stepping/time_integrator.hpp"

namespace tack {
namespace {

constexpr double aim = 0.7;                        // r that is aimed at
constexpr double now_weight = 0.85, before_weight = 0.2;  // over p: exponents of this error and of the last
constexpr double most_growth = 2, least = 0.5;     // of a step to the next
constexpr double least_repeated = 0.1;             // of a step to its repetition
constexpr double alike_from = 0.9, alike_to = 1.2;  // sizes that are not worth a change
constexpr double smallest_ratio = 1e-4;            // what is below is next to nothing
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
    Part part{world.vertices_of(static_cast<int>(i)), {}};
    double mass = 0;
    for (const int v : part.vertices) mass += world.gravitational_mass(v);
    for (const int v : part.vertices) part.weights.push_back(mass > 0 ? world.gravitational_mass(v) : world.is_scalar_dof(v) ? 0 : 1);
    parts_.push_back(std::move(part));
  }
}

double StepControl::slack() const { return round_off * time_.step; }

double StepControl::stop_after(double t) const {
  const auto corner = std::upper_bound(corners_.begin(), corners_.end(), t + slack());
  double stop = corner == corners_.end() ? std::numeric_limits<double>::infinity() : *corner;
  if (!next_) return stop;
  const double due = next_(t);
  return due > t + slack() ? std::min(stop, due) : stop;
}

double StepControl::size(const State& state) const {
  double h = std::min(state.h_next, time_.largest_step());
  if (state.h_max > 0) h = std::min(h, state.h_max);
  const double left = stop_after(state.time) - state.time;
  if (left <= h * (1 + round_off) + slack()) return left;
  return left < 2 * h ? left / 2 : h;
}

double StepControl::measure(const TimeIntegrator& integrator, const State& state, const VecX& x, const VecX& contact, double h) {
  const TimeIntegrator::LocalError error = integrator.local_error(state, x, contact, h);
  double largest = 0;
  for (const Part& part : parts_) {
    double sum = 0, weights = 0;
    for (size_t i = 0; i < part.vertices.size(); ++i) {
      const int v = part.vertices[i];
      if (!world_.dofs.moves(v)) continue;
      sum += part.weights[i] * vertex(error.x, v).squaredNorm();
      weights += part.weights[i];
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
  if (refused_.step == state.step && refused_.h > h * (1 + round_off))
    power = std::clamp(std::log(refused_.ratio / ratio_) / std::log(refused_.h / h), 1.0, power);
  refused_ = {state.step, h, ratio_};
  state.h_next = std::max(h * std::clamp(std::pow(aim / ratio_, 1 / power), least_repeated, alike_from), time_.smallest_step());
  state.no_growth_until = std::max(state.no_growth_until, state.time + h);
  return true;
}

void StepControl::kept(State& state, double h) {
  const double now = std::max(ratio_, smallest_ratio), before = state.error_before > 0 ? state.error_before : aim, planned = state.h_next;
  double factor = std::pow(aim / now, now_weight / power_) * std::pow(before / aim, before_weight / power_);
  factor = std::clamp(factor, least, most_growth);
  if (factor > alike_from && factor < alike_to) factor = 1;
  if (factor > 1 && state.time < state.no_growth_until - slack()) factor = 1;
  state.error_before = now;
  state.h_next = h * factor;
  if (factor >= 1) state.h_next = std::max(state.h_next, planned);  // what was cut short by the end of something
  state.h_next = std::clamp(state.h_next, time_.smallest_step(), time_.largest_step());
  if (state.h_max == 0 || ++state.steady_steps < calm_enough) return;
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
