// The derivatives of the probes of a run by numbers of its scene (output.gradients): of every probe at every time. By direct differentiation,
// step by step beside the run, of which no bit changes: a neighbouring scene for each number (neighbour.hpp), all with one Hessian.
// Source: Kleiber, Antunez, Hien, Kowalczyk 1997, Parameter Sensitivity in Nonlinear Mechanics (direct differentiation, semi-analytical).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/core/warning.hpp"
#include "framework/sensitivity/neighbour.hpp"

namespace tack {

class Gradients {
 public:
  // Of those that the experiment asks for; it must outlive this. Throws InputError for what cannot be differentiated.
  explicit Gradients(BuiltExperiment& run);
  // Why an experiment has no derivatives by a number; "" if it has. Builds it once more.
  static std::string why_not(const BuiltExperiment& run, const GradientConfig& config);
  bool empty() const { return neighbours_.empty(); }

  // "d(force)/d(young)": of the first number, all probes, then of the next. In SI: units of the probe over those of the number.
  std::vector<std::string> columns(const std::vector<std::string>& probes) const;

  void start();
  // As the observer of solved steps of the run's stepper (TimeStepper::observe_solved).
  void solved(const SolvedStep& step);
  void kept(const State& state);
  // At the start or after a step that was kept; probes: what the run's are there.
  std::vector<double> values(const std::vector<double>& probes);

  // Into the history of a state that is stored; and on from one, out of whose history it is taken.
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
