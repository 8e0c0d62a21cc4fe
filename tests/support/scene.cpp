#include "tests/support/scene.hpp"

namespace tack {

TestScene::TestScene(const std::string& yaml) : built(parse_experiment("name: test\n" + yaml, "test.yaml")) {}

TestScene::~TestScene() = default;

}  // namespace tack
