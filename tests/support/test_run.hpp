// A scene written in the test, stepped.
#pragma once

#include "framework/run/simulation.hpp"

namespace tack {

struct TestRun {
  explicit TestRun(const std::string& yaml);  // without `name`
  ~TestRun();

  StepReport step() { return simulation.step(); }
  const State& state() const { return simulation.state(); }
  Vec3 at(int v) const { return vertex(state().x, v); }
  Vec3 rest(int v) const { return vertex(world->rest, v); }
  std::vector<double> sample(size_t probe);
  bool intersects() const;

  std::vector<Warning> warnings;
  Simulation simulation;
  const Experiment& config = simulation.experiment();
  World* const world = &simulation.world();
  PhaseClock& clock = simulation.clock();
  std::vector<std::unique_ptr<Probe>> probes;
  TimeStepper& stepper;
};

}  // namespace tack
