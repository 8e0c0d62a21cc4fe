// A world from a scene written in the test.
#pragma once

#include <string>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/scene/world.hpp"

namespace tack {

struct TestScene {
  explicit TestScene(const std::string& yaml) : root(parse_string("name: test\n" + yaml, "test.yaml")) {
    bind(root, config, "the scene");
    world = build_world(config, root, clock);
  }
  TestScene(const TestScene&) = delete;
  TestScene& operator=(const TestScene&) = delete;

  PhaseClock clock;
  Value root;
  SceneConfig config;
  std::unique_ptr<World> world;
};

}  // namespace tack
