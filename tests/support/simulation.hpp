// A scene written in the test, stepped.
#pragma once

#include "framework/stepping/time_stepper.hpp"
#include "tests/support/scene.hpp"

namespace tack {

struct Simulation : TestScene {
  explicit Simulation(const std::string& yaml)
      : TestScene(yaml),
        stepper(*world, config, clock, [this](const std::string& line) { warnings.push_back(line); }) {
    for (const auto& probe : config.probes) probe->prepare(*world);
  }

  StepReport step() { return stepper.advance(); }
  const State& state() const { return stepper.state(); }
  Vec3 at(int v) const { return vertex(stepper.state().x, v); }
  Vec3 rest(int v) const { return vertex(world->rest, v); }
  std::vector<double> sample(size_t probe) { return config.probes[probe]->sample(*world, state()); }

  std::vector<std::string> warnings;
  TimeStepper stepper;
};

}  // namespace tack
