// Events between steps: what follows the steps of a run, changes prescribed motion and loads
// between them, and wants steps to end where something happens. The time loop (time_stepper.hpp)
// asks after each step, committed but not yet accepted, whether it is repeated.
#pragma once

#include <optional>
#include <vector>

#include "framework/core/state.hpp"
#include "framework/core/step_metric.hpp"

namespace tack {

class StepEvents {
 public:
  virtual ~StepEvents() = default;

  // Begins at a state that was loaded, at which all participants are.
  virtual void start(State& state) = 0;
  // Begins a step at time t [s].
  virtual void begin_step(double t) = 0;
  // Returns the next time after t at which a step has to end [s]; infinity: none.
  virtual double next_stop(double t) const = 0;
  // Called before each try of a step of size h.
  virtual void begin_try(double h) = 0;
  // Judges the committed step of size h. Returns the size with which it is repeated [s]; nothing:
  // it is accepted.
  virtual std::optional<double> repetition(const State& state, double h) = 0;
  // Accepts the judged step: changes the history.
  virtual void accept(State& state) = 0;
  // Returns true once the run is over before its duration.
  virtual bool finished() const = 0;
  // Returns numbers for steps.csv. Their names never change.
  virtual std::vector<StepMetric> metrics() const = 0;
};

}  // namespace tack
