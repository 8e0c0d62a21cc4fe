// The steps of a simulation, typed: how long, how many, and how each is solved.
#pragma once

#include <memory>
#include <optional>

#include "framework/config/field.hpp"
#include "framework/stepping/stepper.hpp"

namespace tack {

// Steps whose sizes follow an error (step_control.hpp).
struct AdaptiveConfig {
  double error = 1e-4;                      // m
  std::optional<double> smallest, largest;  // s
  void fields(Fields& f);
};

struct TimeConfig {
  double step = 0.01;     // s; if steps adapt, the first
  std::optional<AdaptiveConfig> adaptive;
  double duration = 1;    // s
  std::optional<double> wall_limit;  // s of wall time
  int max_cutbacks = 8;
  std::unique_ptr<TimeIntegrator> integrator = Registry<TimeIntegrator>::make("implicit_euler");
  std::unique_ptr<Stepper> stepper = Registry<Stepper>::make("incremental_potential");
  double smallest_step() const;  // of those that adapt [s]
  double largest_step() const;   // of all that are tried [s]
  void fields(Fields& f);
};

}  // namespace tack
