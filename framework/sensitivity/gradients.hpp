// Derivatives of all probes of a run at every time by numbers of its scene (output.gradients).
//
// Method: direct differentiation, step by step beside the run. Each number has a neighbouring scene
// (neighbour.hpp); all share one Hessian. The results of the run itself do not change by a bit.
//
// Source: Kleiber, Antunez, Hien, Kowalczyk 1997, Parameter Sensitivity in Nonlinear Mechanics
// (direct differentiation, semi-analytical).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/core/warning.hpp"
#include "framework/sensitivity/neighbour.hpp"

namespace tack {

class Gradients {
 public:
  // Prepares the derivatives that the experiment requests; `run` must outlive this object. Throws
  // InputError for a number without derivatives.
  explicit Gradients(BuiltExperiment& run);
  // Returns the reason why an experiment has no derivatives by a number; "" if it has them. Builds
  // the experiment once more.
  static std::string reason_without(const BuiltExperiment& run, const GradientConfig& config);
  bool empty() const { return neighbours_.empty(); }

  // Returns the column names, "d(force)/d(young)": all probes of the first number, then of the
  // next. Values are in SI: the unit of the probe over that of the number.
  std::vector<std::string> columns(const std::vector<std::string>& probes) const;

  void start();
  // Observes the solved steps of the run's stepper (TimeStepper::observe_solved).
  void solved(const SolvedStep& step);
  void kept(const State& state);
  // Returns the derivatives at the start or after an accepted step. probes: values of the run
  // there.
  std::vector<double> values(const std::vector<double>& probes);

  // Stores its state in the history of a run's state; start_from() takes it out of the history and
  // continues.
  void store(History& history) const;
  void start_from(State& state);

  std::vector<Warning> doubts() const;  // at the end of a run
  int hessians() const { return system_.factors(); }

 private:
  BuiltExperiment& run_;
  std::vector<std::unique_ptr<Neighbour>> neighbours_;
  TangentSystem system_;
  int steps_ = 0;
};

}  // namespace tack
