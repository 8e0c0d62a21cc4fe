// Step size controller: the size of the next step, and of the repetition of a rejected one.
//
// docs/theory/step_sizes.md has all rules and numbers. A search for the time of an event
// (step_events.hpp) repeats a try by retry(), with the size at which it looks next.
//
// - Constant steps: a cut size stays until the end of the whole step of size time.step.
// - Adaptive steps (time.adaptive) follow the error ratio r = e / time.adaptive.error; e falls with
//   h^p (adaptive_steps.hpp). The next size is
//       h (0.7 / r)^(0.85/p) (r_before / 0.7)^(0.2/p),
//   a PI controller (Gustafsson 1991; Hairer and Wanner 1996, IV.2). Steps end at corners of
//   motions and loads, and do not grow before the time at which a rejected try would have ended:
//   its cause is still ahead.
#pragma once

#include <functional>
#include <vector>

#include "framework/core/state.hpp"
#include "framework/stepping/rejection.hpp"
#include "framework/stepping/time_config.hpp"

namespace tack {

// Error of a solved step.
struct ErrorRatio {
  double length = 0;  // e [m]
  double ratio = 0;   // r = e / time.adaptive.error
  int power = 2;      // p
};

class StepSizeController {
 public:
  // state: of the run. The controller keeps all that outlasts a step in state.step_size.
  // corners: times at which adaptive steps end, ascending [s].
  StepSizeController(const TimeConfig& time, State& state, std::vector<double> corners = {});

  // Sets the first time after t at which an adaptive step has to end [s], besides the corners.
  void stop_at(std::function<double(double t)> next) { next_ = std::move(next); }
  // Sets the first time after t at which a step of either kind has to end [s]: events
  // (step_events.hpp).
  void end_at(std::function<double(double t)> event) { event_ = std::move(event); }
  // Returns the size of the next try [s].
  double size() const { return event_ ? size_to_event() : planned_size(); }
  // Repeats the try with another size [s], which counts for this step alone.
  void retry(double size) { event_size_ = size; }

  // Begins a step at the time of the state.
  void begin();
  // Returns the size of a try of the step, which the functions below judge [s].
  double next() { return h_ = size(); }
  // Rejects the try, to be repeated with its size times `factor`, but at least the smallest size of
  // the reason; factor 1: with the same size, by other means. Returns false, with nothing changed,
  // if the try has the smallest size.
  bool reject(Rejection reason, double factor);
  // Returns the factor for the repetition of a try with a too large error, r > 1.
  double error_factor(const ErrorRatio& error);
  // Accepts the try. The time of the state is its end.
  void accept(const ErrorRatio& error = {});

  bool at_smallest(Rejection reason) const;
  // Returns the smallest size to which a reason cuts steps [s].
  double smallest(Rejection reason) const;
  // Returns the size that cutbacks divide [s].
  double whole() const { return time_.adaptive ? first_size_ : time_.step; }
  // Returns the difference below which times count as equal [s].
  double time_tolerance() const;
  // Returns the rejected tries of the step.
  const RejectionCounts& rejections() const { return rejections_; }

 private:
  double planned_size() const { return time_.adaptive ? adaptive_size() : constant_size(); }
  double size_to_event() const;
  double constant_size() const;
  double adaptive_size() const;
  double whole_steps(double t) const;
  void adapt(const ErrorRatio& error);

  const TimeConfig& time_;
  State& state_;
  std::vector<double> corners_;
  std::function<double(double)> next_, event_;
  double event_size_ = 0;  // largest size of this step, after retry() [s]; 0: none
  double begin_ = 0;       // time at the start of the step [s]
  double first_size_ = 0;  // first size of the step, before cutbacks [s]
  double h_ = 0;           // size of the try [s]
  RejectionCounts rejections_;
  // The last try with a too large error.
  struct {
    double h = 0, ratio = 0;
  } inaccurate_;
};

}  // namespace tack
