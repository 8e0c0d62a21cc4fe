// Step size control by an error (time.adaptive). A formula of another order measures each step
// (TimeIntegrator::local_error):
//     e = max over bodies of sqrt(sum m |e_i|^2 / sum m)  [m],  i: the moving vertices of the body,
//     r = e / time.adaptive.error.
// Masses (for a body without mass: vertices) make e a mean over the body, whatever its mesh. The
// maximum over bodies keeps a large body from hiding a small one.
//
// - r > 1: the step leaves no trace and is repeated, smaller. The error of an impact falls with h
//   and not with h^p, so that from the second time on p is the power that the last two have shown.
// - Otherwise the next step is h (0.7 / r)^(0.85/p) (r_before / 0.7)^(0.2/p), between h/2 and 2 h,
//   and h itself if that is near: a PI controller (Gustafsson 1991; Hairer and Wanner 1996, IV.2).
// - Steps do not grow until the time at which a repeated or failed step would have ended: its cause
//   is still ahead.
// - Where larger steps persistently made or lost energy, steps stay smaller for a while
//   (State::h_max).
// - Abrupt changes of the prescribed motion or of loads, the end of the run, and times of output
//   are ends of steps: from two steps before such a time the rest is divided evenly.
#pragma once

#include <functional>
#include <vector>

#include "framework/stepping/time_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

inline constexpr int calm_enough = 64;  // whole steps, after which larger ones are tried

class StepControl {
 public:
  StepControl(const World& world, const TimeConfig& time);

  // Sets the first time after t at which a step has to end [s], in addition to the world's own
  // times.
  void stop_at(std::function<double(double t)> next) { next_ = std::move(next); }
  // Returns the size of the next step [s].
  double size(const State& state) const;

  // Returns the error [m] of a step of size h from the state to x; the functions below refer to it.
  double measure(const TimeIntegrator& integrator, const State& state, const VecX& x,
                 const VecX& contact, double h);
  // Returns whether the error is too large; then sets the size of the next try in the state.
  bool repeats(State& state, double h);
  bool too_large() const { return ratio_ > 1; }  // no smaller step is allowed
  // Updates the state at the end of a step that is kept.
  void kept(State& state, double h);
  // Updates the state for a step that failed, or made or lost energy, and is repeated with h_next.
  // lasting: larger steps will do so again.
  void refined(State& state, double h, bool lasting);

 private:
  double slack() const;  // s: times that are closer are one
  double stop_after(double t) const;

  const TimeConfig& time_;
  std::vector<double> corners_;  // s, ascending
  std::function<double(double)> next_;
  struct Part {
    std::vector<int> vertices;
    std::vector<double> weights;
  };
  std::vector<Part> parts_;  // of each body
  const World& world_;
  double ratio_ = 0;  // r
  int power_ = 2;     // p
  struct Tried {
    int step = -1;
    double h = 0, ratio = 0;
  } refused_;  // the last
};

}  // namespace tack
