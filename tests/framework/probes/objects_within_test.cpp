// Numbers of objects in regions.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/output/probe.hpp"
#include "geometry/errors.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/scene.hpp"

using namespace tack;

TEST_CASE("objects_within: copies of the object, at their present positions", "[probes]") {
  const auto ball = [](const char* name, double x) {
    return fmt::format("  - {{name: {}, shape: {{type: sphere, radius: 1 cm, cells: 2}}, place: {{translate: [{}, 0, 0]}}, energies: [{{type: neo_hookean, young: 1e5}}]}}\n", name, x);
  };
  TestScene scene("objects:\n" + ball("grain_1", 0) + ball("grain_2", 0.05) + ball("grain_3", 0.1) + ball("grain_old", 0) + ball("stone", 0));
  World& world = *scene.world;
  State state = world.start;
  const auto count = [&](const std::string& of, const std::string& box) {
    const auto probe = component<Probe>(fmt::format("{{type: objects_within, name: n, of: {}, {}}}", of, box));
    probe->prepare(world);
    return probe->sample(world, state).at(0);
  };
  CHECK(count("grain", "min: [-1, -1, -1], max: [1, 1, 1]") == 3);
  CHECK(count("grain", "min: [-1, -1, -1], max: [6 cm, 1, 1]") == 2);
  CHECK(count("grain_2", "min: [-1, -1, -1], max: [6 cm, 1, 1]") == 1);
  CHECK(count("stone", "min: [1 cm, -1, -1], max: [1, 1, 1]") == 0);
  for (int v = 0; v < world.bodies[0].vertex_count; ++v) vertex(state.x, v) += Vec3(0, 2, 0);
  CHECK(count("grain", "min: [-1, -1, -1], max: [6 cm, 1, 1]") == 1);
  CHECK_THROWS_AS(count("grane", "min: [-1, -1, -1], max: [1, 1, 1]"), InputError);
  CHECK_THROWS_AS(count("grain", "min: [-1, 1, -1], max: [1, -1, 1]"), InputError);
}
