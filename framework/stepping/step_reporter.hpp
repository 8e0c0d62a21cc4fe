// Report of a step: its metrics, costs and warnings.
#pragma once

#include <chrono>
#include <string>

#include "framework/core/warning.hpp"
#include "framework/stepping/lagged_impulses.hpp"
#include "framework/stepping/step_report.hpp"
#include "framework/stepping/stepper.hpp"
#include "framework/stepping/time_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

class StepReporter {
 public:
  // `warn` receives warnings.
  StepReporter(const World& world, const SceneConfig& scene, const TimeConfig& time,
               PhaseClock& clock, WarningFunction warn);

  // Begins a step: its costs count from here.
  void begin();
  // Counts what a validation of the step found.
  void add(const Validation& validation);
  // Returns the report of the state that a result led to; all but flows and costs.
  StepReport report(const State& state, const SolveResult& result, double h) const;
  // Ends the step: adds costs, and prints warnings of the state. energy_growth: of the energy
  // balance, or ""; impulses: null if friction does not lag.
  void end(StepReport& report, const State& state, const std::string& energy_growth,
           const LaggedImpulses* impulses);
  // Prints a warning about the step that ended at the state, or that could not be made there.
  void warn(WarningKind kind, int step, double time, const std::string& text,
            const std::string& subject = "") const;

 private:
  using Clock = std::chrono::steady_clock;
  void warn_of(const StepReport& report, const LaggedImpulses* impulses, const State& state);
  void warn_of_joints(const State& state) const;
  void warn_of_unbonded() const;
  int builds() const { return world_.contact ? world_.contact->broad_phase_builds() : 0; }

  const World& world_;
  const SceneConfig& scene_;
  const TimeConfig& time_;
  PhaseClock& clock_;
  WarningFunction warn_;
  // At the start of the step.
  Clock::time_point started_;
  PhaseClock::Seconds seconds_{};
  int builds_ = 0;
  int intersections_ = 0, inverted_tets_ = 0;  // found in the solves of the step
  bool warned_of_strain_ = false;
};

}  // namespace tack
