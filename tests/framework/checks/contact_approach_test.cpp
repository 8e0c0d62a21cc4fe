#include "framework/checks/contact_approach.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "framework/world/world.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

const Mat3 turned = Eigen::AngleAxisd(2.5, Vec3(1, 2, -1).normalized()).toRotationMatrix();

// A disc of radius a under the pressure of Hertz. Heights of the two surfaces at rest and now, as functions of r / a.
template <class Rest, class Now>
std::vector<PressedPoint> disc(double a, const Rest& rest, const Now& now) {
  std::vector<PressedPoint> points;
  constexpr int rings = 60, parts = 24;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < parts; ++j) {
      const double r = (i + 0.5) / rings, angle = 2 * std::numbers::pi * (j + 0.5 * (i % 2)) / parts;
      const Vec3 at(a * r * std::cos(angle), 0, a * r * std::sin(angle));
      PressedPoint p{{Vec3::Zero(), Vec3::Zero()}, {Vec3::Zero(), Vec3::Zero()}, r * std::sqrt(1 - r * r)};
      for (int side = 0; side < 2; ++side) {
        p.rest[side] = turned * (at + rest(side, r, at) * Vec3::UnitY()) + Vec3(3, side, 1);
        p.now[side] = at + now(side, r, at) * Vec3::UnitY();
      }
      points.push_back(p);
    }
  return points;
}

constexpr double a = 0.01, gap = 1e-4;  // m
const auto parallel = [](int side, double, const Vec3&) { return side * gap; };

// A fixed ball above a block, which moves down by 4 mm more than the contact distance, in two steps. The ball has a radius of 5 cm.
std::string ball_on_block(double distance, int cells = 12, const std::string& barrier = "") {
  return fmt::format(
      "time: {{step: 0.5 s, duration: 1 s, integrator: quasi_static}}\n"
      "objects:\n"
      "  - {{name: block, shape: {{type: box, size: [0.08, 0.04, 0.08], cells: [{0}, {1}, {0}]}}, place: {{translate: [0, -0.02, 0]}},\n"
      "     energies: [{{type: neo_hookean, young: 1e6, poisson: 0.3}}], motion: [{{type: fixed, select: {{type: face, direction: [0, -1, 0]}}}}]}}\n"
      "  - {{name: ball, shape: {{type: sphere, radius: 0.05, cells: 20, surface: true}}, place: {{translate: [0, {2}, 0]}},\n"
      "     motion: [{{type: keyframes, frames: [{{time: 0 s}}, {{time: 1 s, translation: [0, {3}, 0]}}]}}]}}\n"
      "contact: {{distance: {4}{5}}}\n",
      cells, cells / 2, 0.05 + distance, -0.004 - distance, distance, barrier);
}

std::vector<Warning> after(const std::string& yaml, int steps) {
  TestRun run(yaml);
  ContactApproach approach(run.config, *run.world);
  for (int i = 0; i < steps; ++i) {
    run.step();
    approach.examine(run.state().x);
  }
  return approach.warnings();
}

double number_after(const std::string& text, const std::string& words) {
  const auto at = text.find(words);
  REQUIRE(at != std::string::npos);
  return std::stod(text.substr(at + words.size()));
}

}  // namespace

TEST_CASE("contact approach: a sphere is flattened by a^2 / 7.6 R, in any orientation") {
  for (const double radius : {0.02, 1.0}) {
    const auto sphere = [&](int side, double r, const Vec3&) { return side * a * a * r * r / (2 * radius); };
    const PressedZone zone = pressed_zone(disc(a, sphere, parallel));
    CHECK(zone.gap == Approx(gap));
    CHECK(zone.curved == Approx(a * a / (7.6 * radius)).epsilon(0.01));
    CHECK(zone.flattened == Approx(zone.curved).epsilon(0.01));
    // Two convex spheres; one in a matching socket; a rigid one.
    const auto both = [&](int side, double r, const Vec3&) { return (2 * side - 1) * a * a * r * r / (2 * radius); };
    CHECK(pressed_zone(disc(a, both, parallel)).curved == Approx(2 * zone.curved).epsilon(0.01));
    const auto socket = [&](int, double r, const Vec3&) { return a * a * r * r / (2 * radius); };
    CHECK(pressed_zone(disc(a, socket, socket)).curved < 1e-9 * a);
    CHECK(pressed_zone(disc(a, sphere, sphere)).flattened < 1e-9 * a);
  }
}

TEST_CASE("contact approach: flat, tilted, folded or too small zones count as flat") {
  const auto flat = [](int, double, const Vec3&) { return 0.0; };
  const auto tilted = [](int side, double, const Vec3& at) { return side * 0.05 * at.x(); };
  const auto folded = [](int side, double r, const Vec3&) { return side * (r > 0.97 ? 0.01 : 0.0); };
  CHECK(pressed_zone(disc(a, flat, parallel)).curved < 1e-9 * a);
  CHECK(pressed_zone(disc(a, tilted, parallel)).curved < 1e-3 * a);
  CHECK(pressed_zone(disc(a, folded, parallel)).curved == 0);
  const auto sphere = [](int side, double r, const Vec3&) { return side * a * r * r; };
  std::vector<PressedPoint> few = disc(a, sphere, parallel);
  few.resize(8);
  CHECK(pressed_zone(few).curved == 0);
  std::vector<PressedPoint> row;
  for (const PressedPoint& p : disc(a, sphere, parallel))
    if (std::abs(p.now[0].z()) < 1e-3 * a) row.push_back(p);
  REQUIRE(row.size() > 20);
  CHECK(pressed_zone(row).curved == 0);
}

TEST_CASE("contact approach: a ball pressed into a block with a large contact distance is warned of, with the recommended one not") {
  const double coarse = 2e-3;
  const std::string line = only_text(after(ball_on_block(coarse), 2), WarningKind::soft_barrier);
  INFO(line);
  CHECK(contains(line, "where 'block' and 'ball' were pressed together, the barrier took "));
  CHECK(contains(line, "contact.distance (0.002 m) is not small"));
  // Since they began to press each other it went down by the distance and 4 mm.
  CHECK(number_after(line, "of their approach of ") == Approx(coarse + 4e-3).epsilon(0.3));
  const double cure = number_after(line, "take ");
  CHECK(cure < coarse / 2);
  CHECK(after(ball_on_block(cure, 16), 2).empty());
}

TEST_CASE("contact approach: a stiffer barrier takes less of it") {
  CHECK(after(ball_on_block(5e-4), 2).size() == 1);
  CHECK(after(ball_on_block(5e-4, 12, ", barrier: {stiffness: 1e7}"), 2).empty());
}

TEST_CASE("contact approach: bodies that are flat where they meet are silent") {
  const std::string blocks =
      "time: {step: 0.02 s, duration: 1 s}\n"
      "gravity: [0, -9.81, 0]\n"
      "objects:\n"
      "  - {name: floor, shape: {type: box, size: [0.4, 0.02, 0.4], cells: [4, 1, 4]}, place: {translate: [0, -0.01, 0]}, motion: [fixed]}\n"
      "  - {name: low, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [4, 4, 4]}, place: {translate: [0, 0.051, 0]}, energies: [{type: neo_hookean, young: 5e4, poisson: 0.3, density: 1000}]}\n"
      "  - {name: high, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}, place: {translate: [0.01, 0.1525, 0], axis: [0, 1, 0], angle: 10 deg}, energies: [{type: neo_hookean, young: 5e4, poisson: 0.3, density: 1000}]}\n"
      "contact: {distance: 2 mm}\n";
  CHECK(after(blocks, 20).empty());
}

TEST_CASE("contact approach: quasi-static runs tell, those that move do not") {
  const TemporaryFolder folder;
  write_file(folder.path() / "ball.yaml", "name: ball\n" + ball_on_block(2e-3, 10));
  const auto warnings = [&](const std::string& integrator) {
    const ProgramResult result = run_tack(folder.path(), {"run", "ball.yaml", "-q", "-o", integrator, "--threads", "1", "--set",
                                                          "time.integrator=" + integrator, "--set", "objects.block.energies.0.density=1000"});
    CHECK(result.exit_code == 0);
    return warned(warnings_in(folder.path() / integrator / "summary.json"), WarningKind::soft_barrier);
  };
  CHECK(warnings("quasi_static"));
  CHECK_FALSE(warnings("implicit_euler"));
}

TEST_CASE("contact approach: adhering surfaces are not examined") {
  std::string yaml = ball_on_block(2e-3);
  yaml.replace(yaml.find("distance: 0.002"), 15, "distance: 0.002, barrier: {stiffness: 1e5}, pairs: [{between: [ball, block], adhesion: {type: fang, peak_traction: 1 kPa}}]");
  CHECK(after(yaml, 2).empty());
}
