// A scene written in the test, stepped.
#pragma once

#include "framework/stepping/time_stepper.hpp"
#include "tests/support/scene.hpp"

namespace tack {

struct Simulation : TestScene {
  explicit Simulation(const std::string& yaml);
  ~Simulation();

  StepReport step() { return stepper.advance(); }
  const State& state() const { return stepper.state(); }
  Vec3 at(int v) const { return vertex(stepper.state().x, v); }
  Vec3 rest(int v) const { return vertex(world->rest, v); }
  std::vector<double> sample(size_t probe);

  std::vector<std::string> warnings;
  TimeStepper stepper;
  std::vector<std::unique_ptr<Probe>> probes;
};

}  // namespace tack
