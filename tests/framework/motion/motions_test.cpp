// Every motion against its closed form, and error messages.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "geometry/errors.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// A small block with a motion of one face.
std::string block(const std::string& motion, const std::string& more = "") {
  return fmt::format("time: {{step: 0.02, duration: 1, max_cutbacks: 20}}\n"
                     "objects: [{{name: block, shape: {{type: box, size: [0.1, 0.1, 0.1]}},\n"
                     "  energies: [{{type: neo_hookean, young: 1e5}}],\n"
                     "  motion: [{{{}, select: {{type: face, direction: [1, 0, 0]}}}}]}}]\n{}", motion, more);
}

Mat3 turn(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

using PrescribedPosition = std::function<Vec3(const Vec3& rest, double t)>;
struct Case {
  std::string motion;
  PrescribedPosition position;
};

const std::vector<Case> cases = {
    {"type: translate, velocity: [0.3, -0.2, 0.1]",
     [](const Vec3& x, double t) { return Vec3(x + t * Vec3(0.3, -0.2, 0.1)); }},
    {"type: translate, displacement: [5 cm, 0, 1 cm], duration: 0.1",
     [](const Vec3& x, double t) { return Vec3(x + std::min(t / 0.1, 1.0) * Vec3(0.05, 0, 0.01)); }},
    {"type: rotate, axis: [1, 2, 0], centre: [0.1, 0, 0], angular_velocity: 90 deg/s",
     [](const Vec3& x, double t) {
       const Vec3 c(0.1, 0, 0);
       return Vec3(c + turn({1, 2, 0}, t * std::numbers::pi / 2) * (x - c));
     }},
    {"type: rotate, axis: [1, 0, 0], angle: 30 deg, duration: 0.1",
     [](const Vec3& x, double t) {
       return Vec3(turn({1, 0, 0}, std::min(t / 0.1, 1.0) * std::numbers::pi / 6) * x);
     }},
    {"type: keyframes, frames: [{time: 0.04}, {time: 0.1, translation: [0.06, 0, 0], rotation: [30 deg, 0, 0]}]",
     [](const Vec3& x, double t) {
       const double u = std::clamp((t - 0.04) / 0.06, 0.0, 1.0);
       return Vec3(turn({1, 0, 0}, u * std::numbers::pi / 6) * x + u * Vec3(0.06, 0, 0));
     }},
    {"type: keyframes, easing: smooth, frames: [{time: 0.04}, {time: 0.1, translation: [0.06, 0, 0], rotation: [30 deg, 0, 0]}]",
     [](const Vec3& x, double t) {
       const double w = std::clamp((t - 0.04) / 0.06, 0.0, 1.0), u = w * w * (3 - 2 * w);
       return Vec3(turn({1, 0, 0}, u * std::numbers::pi / 6) * x + u * Vec3(0.06, 0, 0));
     }},
    {"type: hinge, axis: [0, 2, 0], centre: [0.1, 0, 0.02], angle: [[0.04 s, 0 deg], [0.1 s, 30 deg]]",
     [](const Vec3& x, double t) {
       const Vec3 c(0.1, 0, 0.02);
       return Vec3(c + turn({0, 1, 0}, std::clamp((t - 0.04) / 0.06, 0.0, 1.0) * std::numbers::pi / 6) * (x - c));
     }},
    {"type: formula, x: 0.01 * sin(2 * pi * t), z: Y * t^2",
     [](const Vec3& x, double t) {
       return Vec3(x.x() + 0.01 * std::sin(2 * std::numbers::pi * t), x.y(), x.z() + x.y() * t * t);
     }},
};

void check_positions(const TestRun& run, const PrescribedPosition& position) {
  int fixed_count = 0;
  for (int v = 0; v < 8; ++v) {
    if (run.world->dofs.block(v) >= 0) continue;
    ++fixed_count;
    CHECK((run.at(v) - position(run.rest(v), run.state().time)).norm() <= 1e-15);
  }
  CHECK(fixed_count == 4);
}

std::string error_of(const std::string& yaml) {
  try {
    TestScene scene(yaml);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("fixed vertices are at their prescribed positions in every step") {
  for (const Case& c : cases) {
    INFO(c.motion);
    TestRun run(block(c.motion));
    for (int i = 0; i < 8; ++i) {
      run.step();
      check_positions(run, c.position);
    }
    CHECK(run.warnings.empty());
  }
}

TEST_CASE("the time of a motion follows step cutbacks") {
  for (const Case& c : cases) {
    INFO(c.motion);
    TestRun run(block(c.motion, "solver: {type: projected_newton, tolerance: 1e-2, max_iterations: 1}\n"));
    int steps = 0;
    while (run.state().time < 0.1 - 1e-9 && steps++ < 5000) {
      run.step();
      check_positions(run, c.position);
    }
    CHECK(run.state().time == Approx(0.1).epsilon(1e-9));
    CHECK(steps > 5);
    CHECK_FALSE(run.warnings.empty());
  }
}

TEST_CASE("a motion starts at the positions and the time at which it fixes vertices") {
  TestRun run("time: {step: 0.02, duration: 1}\n"
                 "objects: [{name: block, shape: {type: box, size: [0.1, 0.1, 0.1]}, velocity: [0.5, 0, 0],\n"
                 "  energies: [{type: neo_hookean, young: 1e5}],\n"
                 "  motion: [{type: translate, velocity: [0, 1, 0], from: 0.06},\n"
                 "           {type: fixed, from: 0.04, until: 0.06}]}]\n");
  for (int i = 1; i <= 6; ++i) {
    run.step();
    const double flown = 0.5 * std::min(0.02 * i, 0.04), lifted = std::max(0.02 * i - 0.06, 0.0);
    for (int v = 0; v < 8; ++v)
      CHECK((run.at(v) - run.rest(v) - Vec3(flown, lifted, 0)).norm() <= 1e-12);
  }
}

namespace {

// Two arms in line, with hinges at x = 0 and x = 0.1, and a block at the end of the second one.
std::string chain(const std::string& upper, const std::string& lower, const std::string& hand) {
  return "time: {step: 0.02, duration: 1}\ncontact: {between_prescribed: false, distance: 1e-4}\n"
         "objects:\n"
         "  - {name: lower, shape: {type: box, size: [0.08, 0.01, 0.01]}, place: {translate: [0.15, 0, 0]}, motion: [{" + lower + "}]}\n"
         "  - {name: upper, shape: {type: box, size: [0.08, 0.01, 0.01]}, place: {translate: [0.05, 0, 0]}, motion: [{" + upper + "}]}\n"
         "  - {name: hand, shape: {type: box, size: [0.02, 0.01, 0.01]}, place: {translate: [0.23, 0, 0]}, energies: [{type: neo_hookean, young: 1e5}],\n"
         "     motion: [{" + hand + ", select: {type: face, direction: [-1, 0, 0]}}]}\n";
}
const std::string shoulder = "type: hinge, axis: [0, 0, 1], angle: [[0 s, 0 deg], [0.1 s, 40 deg]]";
const std::string elbow = "type: hinge, carrier: upper, axis: [0, 0, 1], centre: [0.1, 0, 0], angle: [[0 s, 0 deg], [0.1 s, -70 deg]]";

}  // namespace

TEST_CASE("a motion with a carrier moves along with it, and the carrier with its own") {
  TestRun run(chain(shoulder, elbow, "type: translate, carrier: lower, velocity: [0.1, 0, 0]"));
  CHECK(run.world->prescribed_motion.assignments()[2].motion->rigid());
  for (int i = 1; i <= 7; ++i) {
    run.step();
    const double u = std::min(0.2 * i, 1.0), t = 0.02 * i;
    const Mat3 upper = turn({0, 0, 1}, 40 * u * std::numbers::pi / 180), lower = upper * turn({0, 0, 1}, -70 * u * std::numbers::pi / 180);
    const Vec3 at(0.1, 0, 0);
    for (int v = 0; v < 8; ++v) CHECK((run.at(v) - upper * at - lower * (run.rest(v) - at)).norm() <= 1e-15);
    for (int v = 8; v < 16; ++v) CHECK((run.at(v) - upper * run.rest(v)).norm() <= 1e-15);
    int fixed_count = 0;
    for (int v = 16; v < 24; ++v) {
      if (run.world->dofs.block(v) >= 0) continue;
      ++fixed_count;
      CHECK((run.at(v) - upper * at - lower * (run.rest(v) + Vec3(0.1 * t, 0, 0) - at)).norm() <= 1e-15);
    }
    CHECK(fixed_count == 4);
  }
}

TEST_CASE("vertices that are fixed during a motion move along from their positions") {
  TestRun run(chain(shoulder, elbow, "type: fixed, carrier: upper, from: 0.06"));
  for (int i = 1; i <= 3; ++i) run.step();
  std::vector<Vec3> positions_before;
  for (int v = 16; v < 24; ++v) positions_before.push_back(run.at(v));
  const Mat3 before = turn({0, 0, 1}, 24 * std::numbers::pi / 180), after = turn({0, 0, 1}, 40 * std::numbers::pi / 180);
  for (int i = 4; i <= 6; ++i) run.step();
  int fixed_count = 0;
  for (int v = 16; v < 24; ++v) {
    if (run.world->dofs.block(v) >= 0) continue;
    ++fixed_count;
    CHECK((run.at(v) - after * before.transpose() * positions_before[v - 16]).norm() <= 1e-14);
  }
  CHECK(fixed_count == 4);
}

TEST_CASE("impossible carriers are refused") {
  const std::string fixed = "type: fixed";
  const auto check_error = [](const std::string& text, const std::string& message) {
    INFO(text);
    CHECK_THAT(error_of(text), Catch::Contains(message));
  };
  check_error(chain(shoulder, "type: fixed, carrier: uper", fixed), "motion 0 (fixed) of 'lower': its carrier 'uper' is no object; did you mean 'upper'?");
  check_error(chain("type: fixed, carrier: lower", elbow, fixed), "is carried by itself in the end");
  check_error(chain("type: formula, x: t", elbow, fixed), "object 'upper' has no single rigid motion of all its vertices from 0 s to the end");
  check_error(chain(shoulder + ", until: 1", elbow, fixed), "object 'upper' has no single rigid motion");
  check_error(chain(shoulder, elbow + ", along: [1, 0, 0]", fixed), "remove `along` or `across`");
}

// Two motions fix one half of the plate in turn, three the other half.
TEST_CASE("an object that motions fix in turn at all times needs no material") {
  const auto text = [](const std::string& last) {
    const std::string low = "select: {type: face, direction: [-1, 0, 0]}}", high = "select: {type: face, direction: [1, 0, 0]}}";
    return "time: {step: 0.02, duration: 1}\n"
           "objects:\n"
           "  - {name: plate, shape: {type: box, size: [0.1, 0.1, 0.1]},\n"
           "     motion: [{type: fixed, from: 0.06, " + low + ", {type: translate, velocity: [0, 1, 0], until: 0.06, " + low + ",\n"
           "              {type: translate, velocity: [0, 1, 0], until: 0.04, " + high + ", {type: fixed, from: 0.06, " + high + ",\n"
           "              {type: translate, velocity: [0, 1, 0], from: 0.04, until: " + last + ", " + high + "]}\n"
           "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [1, 0, 0]},\n"
           "     energies: [{type: neo_hookean, young: 1e5}]}\n"
           "contact: {distance: 1 mm}\n";
  };
  TestRun run(text("0.06"));
  CHECK_FALSE(run.world->bodies[0].movable);
  for (int i = 1; i <= 6; ++i) {
    run.step();
    for (int v = 0; v < 8; ++v) {
      CHECK_FALSE(run.world->dofs.moves(v));
      CHECK((run.at(v) - run.rest(v) - Vec3(0, std::min(0.02 * i, 0.06), 0)).norm() <= 1e-12);
    }
  }
  CHECK_THAT(error_of(text("0.05")), Catch::Contains("object 'plate' can move but has no energies"));
}

// The free end is thrown, so that steps fail and are cut back around the time at which one motion ends
// and the next begins. Vertices that a failed step fixed must not count.
TEST_CASE("a rejected step fixes no vertices") {
  TestRun run("time: {step: 0.02, duration: 1, max_cutbacks: 20}\n"
                 "solver: {type: projected_newton, tolerance: 1e-2, max_iterations: 1}\n"
                 "objects: [{name: bar, shape: {type: box, size: [0.4, 0.1, 0.1], cells: [4, 1, 1]},\n"
                 "  velocity: [2, 3, 0], energies: [{type: neo_hookean, young: 1e5}],\n"
                 "  motion: [{type: translate, velocity: [0, 0.5, 0], until: 0.025, select: &face {type: face, direction: [-1, 0, 0]}},\n"
                 "    {type: translate, velocity: [0, 0, 0.25], from: 0.025, select: *face}]}]\n");
  double handed_over = 0;  // the end of the last step of the first motion
  while (run.state().time < 0.06) {
    const double before = run.state().time;
    run.step();
    const double t = run.state().time;
    if ((before + t) / 2 < 0.025) handed_over = t;
    for (int v = 0; v < 20; ++v)
      if (run.rest(v).x() < -0.199)
        CHECK((run.at(v) - run.rest(v) - Vec3(0, 0.5 * handed_over, 0.25 * std::max(t - 0.025, 0.0))).norm() <= 1e-14);
  }
  CHECK(run.warnings.size() > 3);
}

TEST_CASE("wrong motions are reported with their location") {
  const auto check_error = [](const std::string& motion, const std::string& message) {
    INFO(motion);
    CHECK_THAT(error_of(block(motion)), Catch::Contains(message));
  };
  check_error("type: formula, y: sin(t", "test.yaml:5:31: y: formula 'sin(t': Missing parenthesis (position 6)");
  check_error("type: formula, y: 2 * tt", "test.yaml:5:31: y: formula '2 * tt': Unexpected token \"tt\" found at position 4");
  check_error("type: formula, y: 2 * tt", "variables: t, X, Y, Z");
  check_error("type: keyframes, frames: [{time: 1}, {time: 1}]", "test.yaml:5:38: frames: times must increase");
  check_error("type: keyframes, frames: []", "test.yaml:5:38: frames");
  check_error("type: translate", "test.yaml:5:12: velocity: give either velocity or displacement");
  check_error("type: translate, velocity: [1, 0, 0], displacement: [1, 0, 0]", "give either");
  check_error("type: translate, displacement: [1, 0, 0]", "displacement: needs the duration");
  check_error("type: rotate, axis: [0, 0, 0], angle: 1, duration: 1", "axis: must not be zero");
  check_error("type: rotate, axis: [0, 0, 1]", "give either angular_velocity or angle");
  check_error("type: rotate, axis: [0, 0, 1], angle: 1", "angle: needs the duration");
  check_error("type: fixed, from: 2, until: 1", "until: must be later than from");
  check_error("type: fixed}, {type: translate, velocity: [1, 0, 0]",
       "test.yaml:3:11: motion 0 (fixed) of 'block' and motion 1 (translate) of 'block' fix 4 vertices at once, "
       "from 0 s to the end; give them different");
  check_error("type: fixed, until: 0.5}, {type: fixed, from: 0.25", "from 0.25 s to 0.5 s");
  CHECK(error_of(block("type: fixed, until: 0.5}, {type: fixed, from: 0.5")).empty());
}

TEST_CASE("a formula without a finite value ends the run, by name") {
  TestRun run(block("type: formula, x: 't < 0.03 ? 0 : 1 / (t - t)'"));
  run.step();
  CHECK_THROWS_WITH(run.step(), Catch::Contains("motion 0 (formula) of 'block': x: 't < 0.03 ? 0 : 1 / (t - t)' is inf at t = 0.04 s"));
}

TEST_CASE("positions that are not finite, or whose squares overflow, are reported with the motion and the object") {
  TestRun far(block("type: translate, velocity: [1e200, 0, 0]"));
  CHECK_THROWS_WITH(far.step(), Catch::Contains("motion 0 (translate) of 'block': puts vertex ") &&
                                    Catch::Contains("it must be finite and at most 1e+100 m away"));
  TestRun formula(block("type: formula, x: 1e99 * 1e99 * t"));
  CHECK_THROWS_WITH(formula.step(), Catch::Contains("motion 0 (formula) of 'block': x: '1e99 * 1e99 * t' is 2e+196 at t = 0.02 s"));
}
