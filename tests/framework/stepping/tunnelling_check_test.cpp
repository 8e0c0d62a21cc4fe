// Bodies whose displacement in a step exceeds their size hit obstacles in their path, and are not
// affected by anything outside it.
#include "framework/stepping/tunnelling_check.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>

#include "tests/support/program.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

std::string scene(double h, const std::string& objects, const std::string& more = "") {
  return fmt::format("time: {{step: {}, duration: {}{}}}\nobjects:\n{}contact: {{distance: 1 mm}}\n", h, 4 * h, more, objects);
}

std::string block(const std::string& name, const Vec3& at, double speed = 0, double young = 1e6, const std::string& more = "") {
  return fmt::format("  - {{name: {}, shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}}, place: {{translate: [{}, {}, {}]}},\n"
                     "     energies: [{{type: neo_hookean, young: {}, poisson: 0.4, density: 1000}}], velocity: [{}, 0, 0]{}}}\n",
                     name, at.x(), at.y(), at.z(), young, speed, more);
}

std::string affine_block(const std::string& name, const Vec3& at, double speed = 0) {
  return fmt::format("  - {{name: {}, shape: {{type: box, size: [0.1, 0.1, 0.1]}}, place: {{translate: [{}, {}, {}]}},\n"
                     "     body: {{type: affine, density: 1000}}, velocity: [{}, 0, 0]}}\n", name, at.x(), at.y(), at.z(), speed);
}

// Advances by one whole step.
struct WholeStep {
  int refused = 0, steps = 0;
  WholeStep(TestRun& run, double h) {
    const double end = run.state().time + h * (1 - 1e-9);
    while (run.state().time < end) {
      refused += run.step().rejections.cutbacks();
      ++steps;
    }
  }
};

double centre(const TestRun& run, int body) { return run.world->centre_of_mass(body, run.state().x).x(); }
double speed_of(const TestRun& run, int body) { return run.world->centre_of_mass(body, run.state().v).x(); }

// Returns the number of steps that were cut back because of bodies that the text names.
int cutbacks_by(const TestRun& run, const std::string& bodies) {
  return static_cast<int>(std::count_if(run.warnings.begin(), run.warnings.end(), [&](const Warning& w) { return w.kind == WarningKind::step_cutback && contains(w.text, bodies); }));
}

const Vec3 origin = Vec3::Zero(), beside(0.101, 0.003, 0.002), ahead(0.101, 0, 0);

// Checks a collision: the bodies share the momentum, and the one behind stays behind.
void check_hit(TestRun& run, double h, double speed) {
  const WholeStep whole(run, h);
  CHECK(whole.refused == 1);
  CHECK(cutbacks_by(run, "tunnelled through") == 1);
  CHECK(centre(run, 1) > centre(run, 0) + 0.05);
  CHECK(speed_of(run, 1) > 0.45 * speed);
  CHECK(speed_of(run, 0) < 0.55 * speed);
  CHECK(speed_of(run, 0) + speed_of(run, 1) == Approx(speed).epsilon(1e-3));
}

}  // namespace

TEST_CASE("bodies hit obstacles in their path, for any displacement in a step", "[stepping]") {
  SECTION("3 m/s at 0.1 s") {
    TestRun run(scene(0.1, block("a", origin, 3) + block("b", beside)));
    check_hit(run, 0.1, 3);
  }
  SECTION("20 and 30 m/s at 10 ms") {
    const double speed = GENERATE(20, 30);
    TestRun run(scene(0.01, block("a", origin, speed) + block("b", beside)));
    check_hit(run, 0.01, speed);
  }
  SECTION("1000 m/s at 1 ms, centred") {
    TestRun run(scene(0.001, block("a", origin, 1000, 1e9) + block("b", ahead, 0, 1e9)));
    check_hit(run, 0.001, 1000);
  }
  SECTION("1000 m/s at 1 ms, affine") {
    TestRun run(scene(0.001, affine_block("a", origin, 1000) + affine_block("b", beside)));
    check_hit(run, 0.001, 1000);
  }
}

TEST_CASE("bodies that pass beside an obstacle, move with it or slide on it are not cut back", "[stepping]") {
  SECTION("beside") {
    TestRun run(scene(0.01, block("a", origin, 30) + block("b", {0.101, 0.105, 0})));
    CHECK(WholeStep(run, 0.01).steps == 1);
    CHECK(centre(run, 0) == Approx(0.3).epsilon(1e-3));
    CHECK(run.warnings.empty());
  }
  SECTION("along") {
    TestRun run(scene(0.001, block("a", origin, 1000) + block("b", beside, 1000) + block("c", {0, 0, 0.5})));
    CHECK(WholeStep(run, 0.001).steps == 1);
    CHECK(run.warnings.empty());
  }
  SECTION("on it") {
    TestRun run("gravity: [0, -9.81, 0]\n" +
                scene(0.01, "  - {name: floor, shape: {type: box, size: [4, 0.1, 1], cells: [20, 1, 5]}, place: {translate: [1, -0.1005, 0]}, motion: [fixed]}\n" +
                                block("a", origin, 30)));
    for (int i = 0; i < 3; ++i) CHECK(WholeStep(run, 0.01).steps == 1);
    CHECK(centre(run, 1) == Approx(0.9).epsilon(1e-3));
    CHECK(run.warnings.empty());
  }
  SECTION("into a soft body") {
    const double speed = GENERATE(10, 30, 100);
    CAPTURE(speed);
    TestRun run(scene(0.01, fmt::format("  - {{name: sheet, shape: {{type: box, size: [0.004, 1, 1], cells: [1, 20, 20]}}, place: {{translate: [0.0535, 0, 0]}},\n"
                                        "     energies: [{{type: neo_hookean, young: 1e5, poisson: 0.3, density: 1000}}],\n"
                                        "     motion: [{{type: fixed, select: {{type: face, direction: [0, 1, 0]}}}}, {{type: fixed, select: {{type: face, direction: [0, -1, 0]}}}}]}}\n") +
                                block("a", origin, speed)));
    CHECK(WholeStep(run, 0.01).steps == 1);
    CHECK(centre(run, 1) > 0.5 * 0.01 * speed);
    CHECK(run.warnings.empty());
  }
  SECTION("spinning beside it") {
    TestRun run(scene(0.01, block("a", origin, 0, 1e7, ", spin: [0, 0, 60]") + block("b", {0.16, 0, 0})));
    WholeStep(run, 0.01);
    CHECK_FALSE(warned(run.warnings, WarningKind::step_cutback));
    CHECK_FALSE(warned(run.warnings, WarningKind::tolerated_step));
  }
}

TEST_CASE("a chain of bodies passes a blow on", "[stepping]") {
  std::string row = block("a", origin, 20);
  for (int i = 1; i < 4; ++i) row += block(fmt::format("b{}", i), {0.101 * i, 0.001 * i, 0.002 * (i % 2)});
  TestRun run(scene(0.01, row));
  const WholeStep whole(run, 0.01);
  CHECK(whole.refused >= 1);
  double sum = speed_of(run, 0);
  for (int i = 1; i < 4; ++i) {
    CHECK(centre(run, i) > centre(run, i - 1) + 0.05);
    sum += speed_of(run, i);
  }
  CHECK(sum == Approx(20).epsilon(1e-3));
  CHECK(speed_of(run, 3) > 1);
}

TEST_CASE("obstacles with prescribed motion carry along the bodies that they hit", "[stepping]") {
  const std::string pushed = block("pushed", beside);
  SECTION("pushed") {
    TestRun run(scene(0.01, "  - {name: ram, shape: {type: box, size: [0.1, 0.1, 0.1]}, motion: [{type: translate, velocity: [30, 0, 0]}]}\n" + pushed));
    const WholeStep whole(run, 0.01);
    CHECK(centre(run, 0) == Approx(0.3));
    CHECK(centre(run, 1) > centre(run, 0) + 0.05);
    CHECK(speed_of(run, 1) > 25);
  }
  SECTION("against an approaching body") {
    TestRun run(scene(0.01, "  - {name: ram, shape: {type: box, size: [0.1, 0.1, 0.1]}, motion: [{type: translate, velocity: [10, 0, 0]}]}\n" +
                                block("comes", {0.2, 0.003, 0.002}, -30)));
    const WholeStep whole(run, 0.01);
    CHECK(centre(run, 1) > centre(run, 0) + 0.05);
  }
}

TEST_CASE("sheets, rods and particles hit obstacles in their path", "[stepping]") {
  const auto ball = [](const Vec3& at) {
    return fmt::format("  - {{name: ball, shape: {{type: sphere, radius: 0.02, cells: 4}}, place: {{translate: [{}, {}, {}]}},\n"
                       "     energies: [{{type: neo_hookean, young: 1e6, poisson: 0.4}}]}}\n", at.x(), at.y(), at.z());
  };
  SECTION("a sheet") {
    TestRun run(scene(0.01, "  - {name: sheet, shape: {type: grid, size: [0.1, 0.1], cells: [4, 4]}, place: {axis: [0, 0, 1], angle: 90 deg, translate: [0.04, 0, 0]},\n"
                            "     shell: {thickness: 1 mm}, velocity: [30, 0, 0], energies: [{type: neo_hookean_membrane, young: 1e7, density: 1000}]}\n" +
                            block("target", {0.101, 0.043, 0.002})));
    WholeStep(run, 0.01);
    CHECK(cutbacks_by(run, "'sheet' tunnelled through 'target'") == 1);
    CHECK(speed_of(run, 1) > 0.05);
  }
  SECTION("a rod") {
    TestRun run(scene(0.01, "  - {name: rod, shape: {type: segment, length: 0.1, edges: 8}, place: {axis: [0, 0, 1], angle: 90 deg, translate: [0.05, 0, 0]},\n"
                            "     rod: {radius: 2 mm}, velocity: [30, 0, 0], energies: [{type: elastic_rod, young: 1e11, density: 7800}]}\n" +
                            ball({0.08, 0.003, 0.008})));
    WholeStep(run, 0.01);
    CHECK(cutbacks_by(run, "'rod' tunnelled through 'ball'") == 1);
    CHECK(speed_of(run, 1) > 1);
    CHECK(run.world->centre_of_mass(0, run.state().x).z() < -0.02);  // glanced off
  }
  SECTION("particles that fly together") {
    TestRun run(scene(0.01, "  - {name: grains, shape: {type: points, size: [0, 0.02, 0.02], counts: [1, 2, 2]}, place: {translate: [0.04, 0, 0]},\n"
                            "     particle: {radius: 2 mm}, velocity: [30, 0, 0], energies: [{type: particle}]}\n" + ball({0.08, 0.003, 0.002})));
    WholeStep(run, 0.01);
    CHECK(cutbacks_by(run, "'grains' tunnelled through 'ball'") == 1);
    CHECK(cutbacks_by(run, "'grains' tunnelled through 'grains'") == 0);
    CHECK(speed_of(run, 1) > 0.02);
  }
}

TEST_CASE("tunnelling at the smallest step size is accepted with a warning", "[stepping]") {
  TestRun run(scene(0.01, block("a", origin, 60) + block("b", beside), ", max_cutbacks: 1"));
  const StepReport report = run.step();
  CHECK(report.step_size == 0.005);
  REQUIRE(run.warnings.size() >= 2);
  CHECK_THAT(first_text(run.warnings, WarningKind::step_cutback), Catch::Contains("'a' tunnelled through 'b': it moved 0.6") && Catch::Contains("0.005 s (1/2 of the step)"));
  CHECK_THAT(first_text(run.warnings, WarningKind::tolerated_step), Catch::Contains("0.1 m long; take a smaller time.step or a larger time.max_cutbacks"));
}
