// A world from a scene written in the test.
#pragma once

#include <string>

#include "framework/scene/build_world.hpp"

namespace tack {

struct TestScene {
  explicit TestScene(const std::string& yaml);  // without `name`
  ~TestScene();
  TestScene(const TestScene&) = delete;
  TestScene& operator=(const TestScene&) = delete;

  PhaseClock clock;
  Value root;
  SceneConfig config;
  std::unique_ptr<World> world;
};

}  // namespace tack
