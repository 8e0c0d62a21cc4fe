#include "framework/checks/element_warnings.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/checks/bent_solids.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

std::vector<Warning> warnings(const std::string& object) {
  TestScene scene("objects:\n  - {name: it, " + object + "}\n");
  return element_warnings(scene.config, *scene.world);
}

std::string cube(double poisson) {
  return fmt::format("shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}}, energies: [{{type: neo_hookean, young: 1e5, poisson: {}}}]", poisson);
}

std::string rod(const std::string& shape, const std::string& energy = "elastic_rod") {
  return "shape: " + shape + ", rod: {radius: 2 mm}, energies: [{type: " + energy + ", young: 1e8}]";
}

std::string ring(int edges) { return fmt::format("{{type: ring, radius: 1, edges: {}}}", edges); }

// A bar of 10 thicknesses, fixed at one end. `more`: loads or another motion.
std::string bar(int cells, const std::string& more, const std::string& body = "energies: [{type: neo_hookean, young: 1e6, poisson: 0.3}]") {
  return fmt::format("time: {{step: 1 s, duration: 1 s, integrator: quasi_static}}\nsolver: {{type: projected_newton, force_tolerance: 1e-6}}\n"
                     "objects:\n  - {{name: bar, shape: {{type: box, size: [0.2, 0.02, 0.02], cells: [{}, {}, {}]}}, {},\n"
                     "     motion: [{{type: fixed, select: {{type: face, direction: [-1, 0, 0]}}}}],\n"
                     "     loads: [{{type: traction, {}, select: {{type: face, direction: [1, 0, 0]}}}}]}}\n", 10 * cells, cells, cells, body, more);
}

std::vector<Warning> after_a_step(const std::string& yaml) {
  TestRun run(yaml);
  BentSolids solids(run.config, *run.world);
  run.step();
  solids.examine(run.state().x);
  return solids.warnings();
}

const std::string down = "value: [0, -2, 0]", along = "value: [1000, 0, 0]";

}  // namespace

TEST_CASE("elements: tets that lock in volume are warned of") {
  const std::string line = only_text(warnings(cube(0.49)), WarningKind::volume_locking);
  CHECK(contains(line, "the linear tets of 'it' lock in volume with a Poisson's ratio of 0.49"));
  CHECK(contains(line, "elements: composite"));
  CHECK(warnings(cube(0.45)).empty());
  for (const std::string elements : {"composite", "patches"}) CHECK(warnings("elements: " + elements + ", " + cube(0.49)).empty());
  // Sheets in plane stress do not.
  CHECK(warnings("shape: {type: grid, size: [1, 1]}, shell: {thickness: 1 mm}, energies: [{type: stvk_membrane, young: 1e5, poisson: 0.49}]").empty());
}

TEST_CASE("elements: curved rods of few edges are warned of") {
  const std::string line = only_text(warnings(rod(ring(16))), WarningKind::coarse_rod);
  CHECK(contains(line, "the edges of 'it' turn by 22.5 degrees from one to the next, 16 for a full turn"));
  CHECK(contains(line, "about 10% off"));
  CHECK(warnings(rod(ring(32))).empty());
  CHECK(warnings(rod(ring(4))).empty());  // a square
  CHECK(warnings(rod(ring(16), "string")).empty());
  CHECK(warnings(rod("{type: segment, length: 1, edges: 3}")).empty());
  CHECK(warnings(rod("{type: net, size: [1, 1], cells: [3, 3]}")).empty());
  CHECK(warnings(rod("{type: helix, radius: 0.1, turns: 3, pitch: 0.02, edges: 60}")).size() == 1);
  CHECK(warnings(rod("{type: helix, radius: 0.1, turns: 3, pitch: 0.02, edges: 120}")).empty());
}

TEST_CASE("elements: slender bodies of few tets that bend are warned of") {
  const std::string line = only_text(after_a_step(bar(2, down)), WarningKind::bending_locking);
  CHECK(contains(line, "'bar' has at most 3 linear tets across"));
  CHECK(contains(line, "use 8 or more, `elements: composite`, or a shell"));
  CHECK(after_a_step(bar(1, down)).size() == 1);
  CHECK(after_a_step(bar(4, down)).size() == 1);
  CHECK(after_a_step(bar(8, down)).empty());
  CHECK(after_a_step(bar(2, along)).empty());  // stretched
  CHECK(after_a_step(bar(2, "value: [0, 0, 0]")).empty());
  const std::string material = ", energies: [{type: neo_hookean, young: 1e6, poisson: 0.3}]";
  CHECK(after_a_step(bar(1, down, "elements: composite" + material)).empty());
  const auto patches = after_a_step(bar(2, down, "elements: patches" + material));
  REQUIRE(patches.size() == 1);
  CHECK(contains(patches[0], "0.32, 0.61, 0.85, 0.95"));
}

TEST_CASE("elements: before the run, slender bodies of few tets are named") {
  TestScene coarse(bar(2, down)), fine(bar(8, down)), block("objects:\n  - {name: it, " + cube(0.3) + "}\n"),
      affine("objects:\n  - {name: it, shape: {type: box, size: [0.2, 0.02, 0.02], cells: [10, 1, 1]}, body: {type: affine, density: 1000}}\n");
  const auto lines = BentSolids(coarse.config, *coarse.world).notes();
  REQUIRE(lines.size() == 1);
  CHECK(contains(lines[0], "where it bends, it will be too stiff"));
  CHECK(BentSolids(fine.config, *fine.world).notes().empty());
  CHECK(BentSolids(block.config, *block.world).notes().empty());
  CHECK(BentSolids(affine.config, *affine.world).notes().empty());
}
