#include "framework/stepping/step_size.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tack {
namespace {

constexpr double ratio_target = 0.7;                        // target of r
constexpr double now_weight = 0.85, before_weight = 0.2;    // exponents of this and the last error, times p
constexpr double growth_max = 2, growth_min = 0.5;          // size of a step over that of the step before
constexpr double repetition_min = 0.1;                      // size of a repetition over that of the try
constexpr double unchanged_min = 0.9, unchanged_max = 1.2;  // factors that are not worth a change of size
constexpr double ratio_min = 1e-4;                          // smaller ratios count as this one
constexpr double round_off = 1e-9;                          // relative
constexpr double drift_max = 1e-10;                         // of the time, a sum of steps: three million of 0.01 s drift by 6e-11
constexpr int max_refinements = 3;                          // halvings of time.step for numerical energy gain or loss
constexpr int steady_steps_min = 64;                        // steps after which larger ones are tried again

}  // namespace

StepSizeController::StepSizeController(const TimeConfig& time, State& state, std::vector<double> corners)
    : time_(time), state_(state), corners_(std::move(corners)) {
  if (state.step_size.h_next == 0) state.step_size.h_next = time.step;
}

double StepSizeController::time_tolerance() const { return round_off * time_.step + drift_max * state_.time; }

// Returns the number of whole constant steps up to t.
double StepSizeController::whole_steps(double t) const { return std::floor((t + time_tolerance()) / time_.step); }

// The last substep ends exactly at the end of the whole step.
double StepSizeController::constant_size() const {
  const double h = state_.step_size.h_next, step = time_.step, left = (whole_steps(state_.time) + 1) * step - state_.time;
  if (h <= left * (1 - round_off)) return h;
  return h >= step ? step : left;
}

// Returns the planned size, or what is left to the next event.
double StepSizeController::size_to_event() const {
  const double h = planned_size(), stop = event_(state_.time), left = stop - state_.time;
  const double size = left <= h * (1 + round_off) + time_tolerance() ? left : h;
  return event_size_ > 0 ? std::min(size, event_size_) : size;
}

// Within two steps of the next corner, the remaining time is divided evenly.
double StepSizeController::adaptive_size() const {
  const StepSizeState& s = state_.step_size;
  double h = std::min(s.h_next, time_.largest_step());
  if (s.h_max > 0) h = std::min(h, s.h_max);
  const double now = state_.time + time_tolerance();
  const auto corner = std::upper_bound(corners_.begin(), corners_.end(), now);
  double stop = corner == corners_.end() ? std::numeric_limits<double>::infinity() : *corner;
  if (next_) {
    const double due = next_(state_.time);
    if (due > now) stop = std::min(stop, due);
  }
  const double left = stop - state_.time;
  if (left <= h * (1 + round_off) + time_tolerance()) return left;
  return left < 2 * h ? left / 2 : h;
}

void StepSizeController::begin() {
  begin_ = state_.time;
  event_size_ = 0;
  first_size_ = size();
  rejections_ = {};
  inaccurate_ = {};
}

double StepSizeController::smallest(Rejection reason) const {
  const auto halved = [](double size, int halvings) { return size * std::pow(0.5, halvings); };
  switch (reason) {
    case Rejection::error: return time_.smallest_step();
    case Rejection::energy_contact:
    case Rejection::energy_free: return halved(time_.step, std::min(max_refinements, time_.max_cutbacks));
    default: return halved(time_.adaptive ? std::max(first_size_, time_.smallest_step()) : time_.step, time_.max_cutbacks);
  }
}

bool StepSizeController::at_smallest(Rejection reason) const { return h_ <= smallest(reason) * (1 + round_off); }

bool StepSizeController::reject(Rejection reason, double factor) {
  if (factor < 1 && at_smallest(reason)) return false;
  ++rejections_[reason];
  if (factor == 1) return true;
  StepSizeState& s = state_.step_size;
  const double least = smallest(reason);
  s.h_next = factor * h_ < least * (1 - round_off) ? least : factor * h_;
  s.no_growth_until = std::max(s.no_growth_until, state_.time + h_);
  if (reason == Rejection::error) first_size_ = s.h_next;
  if (reason == Rejection::energy_free) {  // what moves too fast for the step does so in the following ones too
    s.h_max = time_.adaptive ? s.h_next : time_.step / std::round(time_.step / s.h_next);
    s.steady_steps = 0;
  }
  return true;
}

// The error of an impact falls with h, not with h^p: from the second try on, p is the power that the last two errors show.
double StepSizeController::error_factor(const ErrorRatio& error) {
  double power = error.power;
  if (inaccurate_.h > h_ * (1 + round_off))
    power = std::clamp(std::log(inaccurate_.ratio / error.ratio) / std::log(inaccurate_.h / h_), 1.0, power);
  inaccurate_ = {h_, error.ratio};
  return std::clamp(std::pow(ratio_target / error.ratio, 1 / power), repetition_min, unchanged_min);
}

void StepSizeController::adapt(const ErrorRatio& error) {
  StepSizeState& s = state_.step_size;
  const double now = std::max(error.ratio, ratio_min), before = s.error_before > 0 ? s.error_before : ratio_target, planned = s.h_next;
  double factor = std::pow(ratio_target / now, now_weight / error.power) * std::pow(before / ratio_target, before_weight / error.power);
  factor = std::clamp(factor, growth_min, growth_max);
  if (factor > unchanged_min && factor < unchanged_max) factor = 1;
  if (factor > 1 && state_.time < s.no_growth_until - time_tolerance()) factor = 1;
  s.error_before = now;
  s.h_next = h_ * factor;
  if (factor >= 1) s.h_next = std::max(s.h_next, planned);  // a step that ended at a corner was shortened
  s.h_next = std::clamp(s.h_next, time_.smallest_step(), time_.largest_step());
}

void StepSizeController::accept(const ErrorRatio& error) {
  StepSizeState& s = state_.step_size;
  if (time_.adaptive) adapt(error);
  else if (whole_steps(state_.time) == whole_steps(begin_)) return;
  if (s.h_max > 0 && ++s.steady_steps >= steady_steps_min) {
    s.steady_steps = 0;
    s.h_max *= 2;
    if (s.h_max >= time_.largest_step()) s.h_max = 0;
  }
  if (!time_.adaptive) s.h_next = s.h_max > 0 ? s.h_max : time_.step;
}

}  // namespace tack
