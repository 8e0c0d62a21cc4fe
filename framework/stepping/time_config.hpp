// The steps of a simulation, typed: how long, how many, and how each is solved.
#pragma once

#include <memory>
#include <optional>

#include "framework/config/field.hpp"
#include "framework/stepping/stepper.hpp"

namespace tack {

struct TimeConfig {
  double step = 0.01;     // s
  double duration = 1;    // s
  std::optional<double> wall_limit;  // s of wall time
  int max_halvings = 8;
  std::unique_ptr<TimeIntegrator> integrator = Registry<TimeIntegrator>::make("implicit_euler");
  std::unique_ptr<Stepper> stepper = Registry<Stepper>::make("incremental_potential");
  void fields(Fields& f);
};

}  // namespace tack
