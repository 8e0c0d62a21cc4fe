// Step size control by an error (time.adaptive). A formula of another order measures each step
// (TimeIntegrator::local_error):
//     e = max over bodies of sqrt(sum m |e_i|^2 / sum m)  [m],  i: the moving vertices of the body,
//     r = e / time.adaptive.error.
// Weighting by mass (for a body without mass: by vertices) makes e a mean over the body that does
// not depend on the mesh. The maximum over bodies keeps a large body from hiding a small one.
//
// - r > 1: the step is rejected and repeated with a smaller size. The error of an impact falls with
//   h and not with h^p. After the second rejection p is therefore the power of the last two errors.
// - Otherwise the next step is h (0.7 / r)^(0.85/p) (r_before / 0.7)^(0.2/p), between h/2 and 2 h,
//   and h itself if that is near: a PI controller (Gustafsson 1991; Hairer and Wanner 1996, IV.2).
// - Steps do not grow until the time at which a rejected step would have ended: its cause is still
//   ahead.
// - If larger steps persistently gained or lost energy numerically, steps stay smaller for a while
//   (State::h_max).
// - Abrupt changes of the prescribed motion or of loads, the end of the run, and times of output
//   are ends of steps: within two steps of such a time, the remaining time is divided evenly.
#pragma once

#include <functional>
#include <vector>

#include "framework/stepping/time_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Number of whole steps after which larger ones are tried again.
inline constexpr int steady_steps_min = 64;

class StepControl {
 public:
  StepControl(const World& world, const TimeConfig& time);

  // Sets the first time after t at which a step has to end [s], in addition to the world's own
  // times.
  void stop_at(std::function<double(double t)> next) { next_ = std::move(next); }
  // Returns the size of the next step [s].
  double size(const State& state) const;

  // Returns the error [m] of a step of size h from the state to x. The functions below use it.
  double measure(const TimeIntegrator& integrator, const State& state, const VecX& x,
                 const VecX& contact, double h);
  // Returns whether the step is rejected for its error; if so, sets the size of the repetition in
  // the state.
  bool repeats(State& state, double h);
  // Returns whether the error is above its limit; of an accepted step: no smaller step is allowed.
  bool too_large() const { return ratio_ > 1; }
  // Updates the state at the end of an accepted step of size h.
  void accepted(State& state, double h);
  // Updates the state for a step that failed, or that gained or lost energy numerically, and that
  // is repeated with h_next. lasting: larger steps would do so again.
  void refined(State& state, double h, bool lasting);

 private:
  // Returns the difference below which times count as equal [s].
  double time_tolerance() const;
  double stop_after(double t) const;

  const TimeConfig& time_;
  std::vector<double> corners_;  // times of abrupt changes, ascending [s]
  std::function<double(double)> next_;
  struct WeightedVertices {
    std::vector<int> vertices;
    std::vector<double> weights;
  };
  std::vector<WeightedVertices> bodies_;
  const World& world_;
  double ratio_ = 0;  // r
  int power_ = 2;     // p
  // The last step that was rejected for its error.
  struct Rejected {
    int step = -1;
    double h = 0, ratio = 0;
  } rejected_;
};

}  // namespace tack
