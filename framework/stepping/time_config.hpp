// Configuration of the steps of a simulation: sizes, number and method.
#pragma once

#include <memory>
#include <optional>

#include "framework/config/field.hpp"
#include "framework/stepping/stepper.hpp"

namespace tack {

// Adaptive step sizes by error control (step_size.hpp).
struct AdaptiveConfig {
  double error = 1e-4;                      // m
  std::optional<double> smallest, largest;  // s
  void fields(Fields& f);
};

// Whether steps with numerical energy gain or loss are repeated (time_stepper.hpp).
enum class EnergyRepeats { automatic, always, never };

struct TimeConfig {
  double step = 0.01;  // s; of adaptive steps, the first
  std::optional<AdaptiveConfig> adaptive;
  double duration = 1;               // s
  std::optional<double> wall_limit;  // s of wall time
  int max_cutbacks = 8;
  EnergyRepeats energy_repeats = EnergyRepeats::automatic;
  bool resolve_debonding = false;  // rejects steps that pass over the adhesion of a body
  std::unique_ptr<TimeIntegrator> integrator = Registry<TimeIntegrator>::make("implicit_euler");
  std::unique_ptr<Stepper> stepper = Registry<Stepper>::make("incremental_potential");
  // Returns the smallest size of adaptive steps [s].
  double smallest_step() const;
  // Returns the largest size of all steps [s].
  double largest_step() const;
  void fields(Fields& f);
};

}  // namespace tack
