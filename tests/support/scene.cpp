#include "tests/support/scene.hpp"

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"

namespace tack {

TestScene::TestScene(const std::string& yaml) : root(parse_string("name: test\n" + yaml, "test.yaml")) {
  bind(root, config, "the scene");
  world = build_world(config, root, clock);
}

TestScene::~TestScene() = default;

}  // namespace tack
