// Sensitivities of all probes of a run at every time to scene parameters (output.gradients).
//
// Method: direct differentiation, step by step beside the run. Each parameter has a perturbed scene
// (perturbed_scene.hpp); all share one Hessian. The results of the run itself do not change by a
// bit.
//
// Source: Kleiber, Antunez, Hien, Kowalczyk 1997, Parameter Sensitivity in Nonlinear Mechanics
// (direct differentiation, semi-analytical).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/core/warning.hpp"
#include "framework/sensitivity/perturbed_scene.hpp"

namespace tack {

class Gradients {
 public:
  // Prepares the sensitivities that the experiment requests; `run` must outlive this object. Throws
  // InputError for a parameter without sensitivities.
  explicit Gradients(BuiltExperiment& run);
  // Returns the reason why an experiment has no sensitivities to a parameter; "" if it has them.
  // Builds the experiment once more.
  static std::string reason_without(const BuiltExperiment& run, const GradientConfig& config);
  bool empty() const { return perturbed_scenes_.empty(); }

  // Returns the column names, "d(force)/d(young)": all probes for the first parameter, then for the
  // next. Values are in SI: the unit of the probe over that of the parameter.
  std::vector<std::string> columns(const std::vector<std::string>& probes) const;

  void start();
  // Observes the solved steps of the run's stepper (TimeStepper::observe_solved).
  void follow_solve(const SolvedStep& step);
  void accept(const State& state);
  // Returns the derivatives at the start or after an accepted step. probes: values of the run
  // there.
  std::vector<double> values(const std::vector<double>& probes);

  // Stores its state in the history of a run's state; start_from() takes it out of the history and
  // continues.
  void store(History& history) const;
  void start_from(State& state);

  std::vector<Warning> warnings() const;  // at the end of a run
  int hessians() const { return system_.factors(); }

 private:
  BuiltExperiment& run_;
  std::vector<std::unique_ptr<PerturbedScene>> perturbed_scenes_;
  TangentSystem system_;
  int steps_ = 0;
};

}  // namespace tack
