// Report of one accepted time step: a row of steps.csv.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/core/minimizer.hpp"
#include "framework/core/phase_clock.hpp"
#include "framework/core/step_metric.hpp"
#include "framework/core/records.hpp"
#include "framework/stepping/energy_flows.hpp"
#include "framework/stepping/rejection.hpp"

namespace tack {

struct StepReport {
  int step = 0;          // accepted steps so far, this one included
  double time = 0;       // at the end of the step [s]
  double step_size = 0;  // h [s]; smaller than the scene's after a cutback
  RejectionCounts rejections;
  std::optional<double> error;  // of the step, if sizes are adaptive (adaptive_steps.hpp) [m]
  MinimizerResult solve;
  bool converged = false;
  double affine_strain = 0;     // largest strain of any affine body
  double unbalanced_force = 0;  // largest force residual at a vertex [N]
  double tolerated_force = 0;   // its limit [N]
  int contacts = 0;             // active stencils
  int candidates = 0;
  double min_distance = 0;  // between primitives that may touch [m]; infinity without candidates
  double min_gap = 0;       // between primitives of different objects [m]
  int broad_phase_builds = 0;
  std::vector<NamedEnergy> energies;  // by name, kinetic energy included
  EnergyFlows flows;
  int lag_iterations = 0;           // solves with updated lagged forces; 0 without friction
  double friction_residual = 0;     // change by another update, relative to the largest force
  bool lag_converged = true;        // false: contact.lagging.until was not reached
  std::vector<StepMetric> metrics;  // of the stepper
  // Counts of the exact check in the solves of this step; a solve with any is rejected.
  int intersections = 0;
  int inverted_tets = 0;
  double wall_seconds = 0;
  PhaseClock::Seconds phases{};
};

}  // namespace tack
