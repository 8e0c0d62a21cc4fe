// A world from a scene written in the test.
#pragma once

#include <string>

#include "framework/config/bind.hpp"
#include "framework/experiment/built_experiment.hpp"

namespace tack {

struct TestScene {
  explicit TestScene(const std::string& yaml);  // without `name`
  ~TestScene();
  TestScene(const TestScene&) = delete;
  TestScene& operator=(const TestScene&) = delete;

  BuiltExperiment built;
  const Experiment& config = built.experiment();
  World* const world = &built.world();
  PhaseClock& clock = built.clock();
  const std::unique_ptr<Minimizer> solver = instance_of(*config.solver);
};

}  // namespace tack
