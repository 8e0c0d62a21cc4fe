// Hulls of fixed triangles have an outer side only; rooms and shells have two sides.
#include "framework/world/hulls.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// A block 1 mm above a plate of a thickness.
std::string above(double thickness, const std::string& plate) {
  return fmt::format(
      "time: {{step: 1 ms, duration: 1 ms}}\nobjects:\n"
      "  - {{name: block, shape: {{type: box, size: [0.1, 0.01, 0.1], cells: [4, 1, 4]}}, place: {{translate: [0, 6 mm, 0]}},\n"
      "     energies: [{{type: neo_hookean, young: 10 MPa, density: 1000}}]}}\n"
      "  - {{name: plate, shape: {{type: box, size: [0.1, {0}, 0.1], cells: [8, 1, 8]{2}}}, place: {{translate: [0, {1}, 0]}}, motion: [fixed]}}\n"
      "contact:\n  distance: 0.2 mm\n"
      "  pairs: [{{between: [block, plate], adhesion: {{type: fang, peak_traction: 1 kPa, peak_distance: 1 mm, range: 2 mm}}}}]\n"
      "probes: [{{name: f, type: contact_force, on: plate, from: block, part: adhesion, direction: [0, 1, 0]}}]\n",
      thickness, -thickness / 2, plate);
}

}  // namespace

TEST_CASE("adhesion is not felt through a thin hull of triangles", "[contact][hulls]") {
  for (const double thickness : {1.5e-3, 0.5e-3, 0.2e-3}) {
    INFO(thickness);
    TestRun run(above(thickness, ", surface: true"));
    CHECK(find_hulls(*run.world) == std::vector<char>{0, 1});
    run.step();
    TestRun tets(above(thickness, ""));
    CHECK(find_hulls(*tets.world) == std::vector<char>{0, 0});
    tets.step();
    const double force = run.sample(0)[0];
    CHECK(force > 9);  // of the 10 N of strength times area, a little nearer than its peak
    CHECK(force == Approx(tets.sample(0)[0]).epsilon(1e-6));
  }
}

TEST_CASE("a room has an inner side", "[contact][hulls]") {
  TestRun run(
      "time: {step: 5 ms, duration: 1}\ngravity: [0, -9.81, 0]\nobjects:\n"
      "  - {name: room, shape: {type: box, size: [0.2, 0.2, 0.2], cells: [2, 2, 2], surface: true}, motion: [fixed]}\n"
      "  - {name: block, shape: {type: box, size: [0.05, 0.05, 0.05]}, place: {translate: [0.01, -0.07, 0.02]},\n"
      "     energies: [{type: neo_hookean, young: 1 MPa, density: 1000}]}\n"
      "contact: {distance: 1 mm}\n"
      "probes: [{name: f, type: contact_force, on: block, from: room, direction: [0, 1, 0]}]\n");
  CHECK(find_hulls(*run.world) == std::vector<char>{0, 0});
  for (int i = 0; i < 60; ++i) run.step();
  CHECK(run.sample(0)[0] == Approx(9.81 * 0.125).epsilon(0.05));  // its weight
}

TEST_CASE("shells, open meshes and moving bodies are no hulls", "[contact][hulls]") {
  const auto hulls = [](const std::string& object) {
    TestScene scene("objects:\n  - {name: a, " + object + "}\n"
                    "  - {name: b, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [1, 0, 0]}, energies: [{type: neo_hookean, young: 1 MPa, density: 1000}]}\n"
                    "contact: {distance: 1 mm}\n");
    return find_hulls(*scene.world);
  };
  const std::string box = "shape: {type: box, size: [0.1, 0.1, 0.1], surface: true}";
  CHECK(hulls(box + ", motion: [fixed]") == std::vector<char>{1, 0});
  CHECK(hulls(box + ", motion: [{type: translate, velocity: [1, 0, 0]}]") == std::vector<char>{1, 0});
  CHECK(hulls(box + ", shell: {thickness: 1 mm}, motion: [fixed]") == std::vector<char>{0, 0});
  CHECK(hulls(box + ", shell: {thickness: 1 mm}, energies: [{type: stvk_membrane, young: 1 MPa, density: 1000}]") == std::vector<char>{0, 0});
  CHECK(hulls("shape: {type: grid, size: [0.1, 0.1], cells: [2, 2]}, motion: [fixed]") == std::vector<char>{0, 0});
  CHECK(hulls("shape: {type: box, size: [0.1, 0.1, 0.1]}, motion: [fixed]") == std::vector<char>{0, 0});
}
