// Joints: exactness in trees, loops and between moving objects; limits, friction, motors against closed forms; refused joints.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "framework/checks/derivative_check.hpp"
#include "framework/output/csv.hpp"
#include "framework/world/joint_relations.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;
using Catch::Contains;

namespace {

constexpr double pi = std::numbers::pi;

// Bars of 0.2 m along x from the origin on, one behind the other, of 0.1 kg each.
std::string bar(int i, const std::string& more = "") {
  return "  - {name: bar_" + std::to_string(i) + ", shape: {type: box, size: [0.2, 0.01, 0.05]}, place: {translate: [" + std::to_string(0.1 + 0.2 * i) +
         ", 0, 0]}, body: {type: affine, density: 1000}" + more + "}\n";
}
std::string scene(const std::string& objects, const std::string& interactions, const std::string& more = "", const std::string& time = "step: 5 ms, duration: 1") {
  return "time: {" + time + "}\nsolver: {type: projected_newton, tolerance: 1e-7}\nobjects:\n" + objects + "interactions: [" + interactions + "]\n" + more;
}
const std::string hinge = "{type: hinge, name: h, object: bar_0, at: [0, 0, 0], axis: [0, 0, 1]";
const std::string gravity = "gravity: [0, -9.81, 0]\n";
const std::string angle = "probes: [{name: angle, type: joint_angle, interaction: h}]\n";

double worst(const TestRun& run) {
  double most = 0;
  for (const Joint& joint : run.world->constraints.joints()) most = std::max(most, joint_error(joint, run.state().x));
  return most;
}

}  // namespace

TEST_CASE("joints of all kinds are exact, in chains, between moved and deformable objects", "[joints]") {
  const std::string joints =
      "{type: ball, name: a, object: bar_0, to: hand, at: [0, 0, 0]}, {type: hinge, name: b, object: bar_1, to: bar_0, at: [0.2, 0, 0], axis: [0, 1, 1]}, "
      "{type: weld, name: c, object: bar_1, to: bar_2, at: [0.4, 0, 0]}, {type: ball, name: d, object: soft, to: bar_2, at: [0.61, 0, 0]}";
  TestRun run(scene("  - {name: hand, shape: {type: box, size: [0.02, 0.02, 0.02]}, motion: [{type: translate, velocity: [0.3, 0, 0.2]}]}\n" + bar(0) + bar(1) + bar(2) +
                        "  - {name: soft, shape: {type: box, size: [0.04, 0.04, 0.04], cells: [2, 2, 2]}, place: {translate: [0.62, 0, 0]}, energies: [{type: neo_hookean, young: 1 MPa, density: 500}]}\n",
                    joints, gravity));
  for (int i = 0; i < 40; ++i) run.step();
  CHECK(worst(run) < 1e-12);
  // The weld: both bars in one line still.
  const auto axis = [&](int i) {
    const Body& body = run.world->bodies[static_cast<size_t>(i + 1)];
    return Vec3((run.at(body.first_vertex + 1) - run.at(body.first_vertex)).normalized());
  };
  CHECK(axis(1).dot(axis(2)) == Approx(1).epsilon(1e-7));
  CHECK(axis(0).dot(axis(1)) < 0.999);
  CHECK(run.at(run.world->bodies[3].first_vertex).y() < -0.05);
}

TEST_CASE("a loop of joints needs no penalty: redundant constraints are removed", "[joints]") {
  // A four-bar linkage: a parallelogram of two cranks and a coupler.
  const std::string objects = "  - {name: a, shape: {type: box, size: [0.02, 0.2, 0.02]}, place: {translate: [0, 0.1, 0]}, body: {type: affine, density: 1000}}\n"
                              "  - {name: b, shape: {type: box, size: [0.3, 0.02, 0.02]}, place: {translate: [0.15, 0.2, 0]}, body: {type: affine, density: 1000}}\n"
                              "  - {name: c, shape: {type: box, size: [0.02, 0.2, 0.02]}, place: {translate: [0.3, 0.1, 0]}, body: {type: affine, density: 1000}}\n";
  const std::string joints = "{type: hinge, name: left, object: a, at: [0, 0, 0], axis: [0, 0, 1], motor: {speed: 2 rad/s, torque: 10 N m}}, "
                             "{type: hinge, name: top_left, object: b, to: a, at: [0, 0.2, 0], axis: [0, 0, 1]}, "
                             "{type: hinge, name: top_right, object: c, to: b, at: [0.3, 0.2, 0], axis: [0, 0, 1]}, {type: hinge, name: right, object: c, at: [0.3, 0, 0], axis: [0, 0, 1]}";
  TestRun run(scene(objects, joints, "probes: [{name: l, type: joint_angle, interaction: left}, {name: r, type: joint_angle, interaction: right}, {name: t, type: joint_angle, interaction: top_left}]\n"));
  const SolvedJoints solved = solve_joints(run.world->constraints.joints(), run.world->constraints.frames(), run.world->prescribed_motion.free(run.world->prescribed_motion.active(0)),
                                           run.world->constraints.unjoined_at(run.world->prescribed_motion.free(run.world->prescribed_motion.active(0)), {}));
  CHECK(solved.redundant == 1);
  while (run.state().time < 0.5) run.step();
  CHECK(worst(run) < 1e-12);
  const double turned = run.sample(0)[0];
  CHECK(turned == Approx(1).epsilon(0.02));
  CHECK(run.sample(1)[0] == Approx(turned).epsilon(1e-4));   // a parallelogram
  CHECK(run.sample(2)[0] == Approx(-turned).epsilon(1e-4));
}

TEST_CASE("hinges count whole turns, and start at the given angle", "[joints]") {
  TestRun run(scene(bar(0, ", spin: [0, 0, 20], velocity: [0, 2, 0]"), hinge + ", start: 30 deg}", angle, "step: 2 ms, duration: 1, integrator: newmark"));
  CHECK(run.sample(0)[0] == Approx(pi / 6));
  while (run.state().time < 0.9) run.step();
  CHECK(run.sample(0)[0] == Approx(pi / 6 + 18).epsilon(5e-3));
}

TEST_CASE("initial velocities that joints do not allow are projected like an impact", "[joints]") {
  // A bar that flies at right angles, caught at its end: L = m v l/2 is conserved, so w = 3 v / (2 l).
  TestRun run(scene(bar(0, ", velocity: [0, 1, 0]"), hinge + "}", angle, "step: 1 ms, duration: 1"));
  run.step();
  CHECK(run.sample(0)[0] / 1e-3 == Approx(1.5 / 0.2).epsilon(5e-3));
}

TEST_CASE("derivatives of limits, friction, motors and lines are those of their values", "[joints]") {
  TestScene s(scene(bar(0) + bar(1) + bar(2),
                    hinge + ", damping: 0.1, friction: {torque: 0.2 N m}, motor: {speed: 1, torque: 2}, position_motor: {angle: 0.3, torque: 1, within: 0.5}, limits: {low: -20 deg, high: 30 deg, margin: 25 deg}}, "
                            "{type: slider, name: s, object: bar_1, to: bar_0, at: [0.2, 0, 0], axis: [1, 0.3, 0], damping: 3, friction: {force: 2 N}, limits: {low: -0.1, high: 0.2, margin: 0.15}}, "
                            "{type: slider, name: t, object: bar_2, at: [0.5, 0, 0], axis: [0, 1, 0], motor: {speed: 1, force: 2}}"));
  int seen = 0;
  for (const DerivativeCheck& check : check_derivatives(*s.world, 0.01, s.clock)) {
    INFO(check.term);
    CHECK_FALSE(check.wrong());
    if (!check.term.starts_with("joint_")) continue;
    ++seen;
    CHECK(check.active());
  }
  CHECK(seen == 3);
}

TEST_CASE("dry friction stops a bar by Coulomb's law, and its dissipation is recorded", "[joints]") {
  // I = m l^2 / 3 about its end: w = w0 - T t / I.
  const double inertia = 0.1 * (0.2 * 0.2 / 3 + 0.01 * 0.01 / 12), w0 = 5, torque = 0.02;
  TestRun run(scene(bar(0, ", spin: [0, 0, 5], velocity: [0, 0.5, 0]"), hinge + ", friction: {torque: 0.02 N m}}", angle, "step: 1 ms, duration: 1"));
  const double stops = w0 * inertia / torque;
  double dissipated = 0, before = 0, half = 0;
  while (run.state().time < 1.5 * stops) {
    before = run.sample(0)[0];
    dissipated += run.step().flows.of("dissipated_joints");
    if (run.state().time < stops / 2) half = (run.sample(0)[0] - before) / 1e-3;
  }
  CHECK(half == Approx(w0 / 2).epsilon(0.01));
  CHECK((run.sample(0)[0] - before) / 1e-3 == Approx(0).margin(1e-3));
  CHECK(run.sample(0)[0] == Approx(w0 * stops / 2).epsilon(0.01));
  CHECK(dissipated == Approx(inertia * w0 * w0 / 2).epsilon(0.02));
}

TEST_CASE("viscous damping lets a bar run out exponentially; a slider's motor stalls against its weight", "[joints]") {
  const double inertia = 0.1 * (0.2 * 0.2 / 3 + 0.01 * 0.01 / 12), c = 0.01;
  TestRun run(scene(bar(0, ", spin: [0, 0, 5], velocity: [0, 0.5, 0]"), hinge + ", damping: 0.01}", angle, "step: 1 ms, duration: 1, integrator: bdf2"));
  while (run.state().time < 0.2) run.step();
  CHECK(run.sample(0)[0] == Approx(5 * inertia / c * (1 - std::exp(-c * run.state().time / inertia))).epsilon(2e-3));

  const std::string slider = "{type: slider, name: s, object: bar_0, at: [0.1, 0, 0], axis: [0, 1, 0], motor: {speed: 0.1 m/s, force: ";
  const std::string probes = gravity + "probes: [{name: w, type: joint_way, interaction: s}, {name: f, type: motor_force, interaction: s}, {name: j, type: joint_force, interaction: s}]\n";
  TestRun strong(scene(bar(0), slider + "1.2 N}}", probes)), weak(scene(bar(0), slider + "0.9 N}}", probes));
  for (int i = 0; i < 100; ++i) strong.step(), weak.step();
  const double gains = (1.2 - 0.981) / 0.1;  // m/s^2, up to its speed
  CHECK(strong.sample(0)[0] == Approx(0.1 * 0.5 - 0.1 * 0.1 / (2 * gains)).epsilon(0.02));
  CHECK(strong.sample(1)[0] == Approx(0.981).epsilon(0.01));
  CHECK(strong.sample(2)[1] == Approx(0.981).epsilon(0.01));
  CHECK(weak.sample(1)[0] == Approx(0.9).epsilon(1e-6));
  CHECK(weak.sample(0)[0] == Approx(-0.5 * 0.81 * 0.25).epsilon(0.03));  // falls by (0.981 - 0.9) N / 0.1 kg
}

TEST_CASE("limits are unilateral at any speed and step size", "[joints]") {
  for (const double unit : {1.0, 1e-3, 1e3}) {
    const auto length = [&](double x) { return std::to_string(x * unit); };
    TestRun run(scene("  - {name: bar_0, shape: {type: box, size: [" + length(0.2) + ", " + length(0.02) + ", " + length(0.05) + "]}, place: {translate: [" + length(0.1) +
                          ", 0, 0]}, body: {type: affine, density: 1000}, spin: [0, 0, 40], velocity: [0, " + length(4) + ", 0]}\n",
                      hinge + ", limits: {low: -10 deg, high: 50 deg}}", angle, "step: 20 ms, duration: 1"));
    for (int i = 0; i < 20; ++i) {
      run.step();
      INFO(unit << " " << i);
      CHECK(run.sample(0)[0] < 50 * pi / 180);
      CHECK(run.sample(0)[0] > -10 * pi / 180);
    }
    CHECK(worst(run) < 1e-12 * unit);
  }
}

TEST_CASE("a slider on a rotating body stays on its line within its stiffness", "[joints]") {
  // Its limit stops it 0.1 m further out, at 10 rad/s.
  TestRun run(scene(bar(0, ", spin: [0, 0, 10], velocity: [0, 1, 0]") + bar(1, ", spin: [0, 0, 10], velocity: [0, 3, 0]"),
                    hinge + "}, {type: slider, name: s, object: bar_1, to: bar_0, at: [0.2, 0, 0], axis: [1, 0, 0], limits: {low: -0.05, high: 0.1}}",
                    "probes: [{name: w, type: joint_way, interaction: s}, {name: e, type: joint_error, interaction: s}]\n", "step: 2 ms, duration: 1"));
  double most = 0, far = 0;
  for (int i = 0; i < 150; ++i) {
    run.step();
    most = std::max(most, run.sample(1)[0]), far = std::max(far, run.sample(0)[0]);
  }
  CHECK(far < 0.1);
  CHECK(far > 0.09);
  CHECK(most < 1e-4 * 0.2);
}

TEST_CASE("a slider that is too soft for its load gets a warning with its name", "[joints]") {
  TestRun run(scene(bar(0, ", motion: [fixed]") + bar(1), "{type: slider, name: s, object: bar_1, to: bar_0, at: [0.2, 0, 0], axis: [1, 0, 0], stiffness: 10 N/m}", gravity, "step: 10 ms, duration: 1"));
  run.step();
  CHECK_THAT(first_text(run.warnings, WarningKind::joint_play), Catch::Contains("'s'"));
  for (const Warning& warning : run.warnings) CHECK(warning.subject == "s");
}

TEST_CASE("a joint of two temporarily fixed objects acts after their release", "[joints]") {
  TestRun run(scene(bar(0, ", motion: [{type: fixed, until: 0.1 s}]") + bar(1), hinge + "}, {type: ball, name: b, object: bar_1, to: bar_0, at: [0.2, 0, 0]}", gravity + angle));
  while (run.state().time < 0.099) run.step();
  CHECK(run.sample(0)[0] == Approx(0).margin(1e-12));
  while (run.state().time < 0.3) run.step();
  CHECK(run.sample(0)[0] < -0.05);
  CHECK(worst(run) < 1e-12);
}

TEST_CASE("impossible joints are refused with a remedy", "[joints]") {
  const auto error = [](const std::string& joints, const std::string& more = "") { TestScene{scene(bar(0) + bar(1, more), joints)}; };
  CHECK_THROWS_WITH(error("{type: ball, name: j, object: bar_9, at: [0, 0, 0]}"), Contains("test.yaml:7:16: interaction 'j': ") && Contains("'bar_9'"));
  CHECK_THROWS_WITH(error("{type: ball, name: j, object: bar_0, to: bar_0, at: [0, 0, 0]}"), Contains("joins 'bar_0' to itself"));
  CHECK_THROWS_WITH(error(hinge + "}, {type: ball, name: j, object: bar_0, at: [0, 0, 0]}"), Contains("joint 'j' repeats the relations of 'h'"));
  CHECK_THROWS_WITH(error("{type: ball, name: j, object: bar_1, at: [0.2, 0, 0]}", ", motion: [fixed]"), Contains("joint 'j' moves nothing"));
  CHECK_THROWS_WITH(error("{type: ball, name: j, object: bar_1, at: [0.2, 0, 0]}", ", motion: [{type: fixed, along: [0, 0, 1]}]"), Contains("fixes some of its directions"));
  CHECK_THROWS_WITH(error("{type: hinge, name: j, object: bar_1, at: [0.2, 0, 0], axis: [0, 0, 0]}"), Contains("an axis without a direction"));
  CHECK_THROWS_WITH(error(hinge + ", limits: {low: 1 deg, high: 9 deg}}"), Contains("joint 'h' starts at 0 rad, not between its limits"));
  CHECK_THROWS_WITH(error(hinge + ", limits: {low: 9 deg, high: 1 deg}}"), Contains("is not below `high`"));
  const auto soft = [](const std::string& to) {
    return scene("  - {name: soft, shape: {type: box, size: [1, 1, 1]}, energies: [{type: neo_hookean, young: 1 MPa, density: 500}]}\n", "{type: ball, name: j, object: soft, " + to + "at: [0, 0, 0]}");
  };
  CHECK_THROWS_WITH(TestScene(soft("")), Contains("none of 'soft' is an affine body that may move"));
  CHECK_THROWS_WITH(TestRun(scene(bar(0), "{type: ball, name: j, object: bar_0, at: [0, 0, 0]}", "probes: [{name: p, type: joint_angle, interaction: j}]\n")),
                    Contains("the interaction 'j' is of type ball"));
  // Two motions that pull a joint apart.
  TestRun torn(scene(bar(0, ", motion: [{type: fixed, until: 1 s}]") + bar(1, ", motion: [{type: translate, velocity: [1, 0, 0], until: 1 s}]"), "{type: ball, name: j, object: bar_1, to: bar_0, at: [0.2, 0, 0]}"));
  CHECK_THROWS_WITH(torn.step(), Contains("joint 'j' would be torn"));
}

TEST_CASE("joined objects are in contact only on request", "[joints]") {
  const std::string contact = "contact: {distance: 1 mm}\n", ball = "{type: ball, name: j, object: bar_1, to: bar_0, at: [0.2, 0, 0]";
  CHECK_NOTHROW(TestScene(scene(bar(0) + bar(1), ball + "}", contact)));
  CHECK_THROWS_WITH(TestScene(scene(bar(0) + bar(1), ball + ", contact: true}", contact)), Contains("the start"));
}

TEST_CASE("joints resume bit for bit, with any number of threads", "[joints]") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml",
             "name: joints\n" + scene(bar(0, ", spin: [0, 0, 30], velocity: [0, 3, 0]") + bar(1),
                                      hinge + ", friction: {torque: 0.01 N m}}, {type: hinge, name: i, object: bar_1, to: bar_0, at: [0.2, 0, 0], axis: [0, 0, 1], limits: {low: -1, high: 1}}",
                                      gravity + "probes: [{name: a, type: joint_angle, interaction: h}, {name: f, type: joint_force, interaction: i}]\noutput: {checkpoint_interval: 0.1 s, frames: false}\n",
                                      "step: 5 ms, duration: 0.4, integrator: bdf2"));
  REQUIRE(run_tack(folder.path(), {"run", "scene.yaml", "-o", "whole", "--threads", "1"}).exit_code == 0);
  REQUIRE(run_tack(folder.path(), {"run", "scene.yaml", "-o", "parts", "--steps", "50", "--threads", "2"}).exit_code == 0);
  REQUIRE(run_tack(folder.path(), {"run", "scene.yaml", "-o", "parts", "--resume", "--threads", "2"}).exit_code == 0);
  CHECK(file_text(folder.path() / "parts/probes.csv") == file_text(folder.path() / "whole/probes.csv"));
  CHECK(run_tack(folder.path(), {"check", "scene.yaml"}).exit_code == 0);
}

TEST_CASE("a rope is slack up to its length, and pulls beyond it", "[joints]") {
  // A bar of 0.1 kg falls by 0.1 m, then hangs on 1 kN/m, 0.981 mm longer.
  TestRun run(scene(bar(0), "{type: rope, name: r, from: {object: bar_0, at: [0.1, 0, 0]}, to: {at: [0.1, 0.3, 0]}, length: 0.4 m, stiffness: 1 kN/m}",
                    gravity + "probes: [{name: f, type: rope_force, interaction: r}]\n", "step: 5 ms, duration: 5"));
  for (int i = 0; i < 20; ++i) run.step();
  CHECK(run.sample(0)[1] == 0);
  for (int i = 0; i < 600; ++i) run.step();
  CHECK(run.sample(0)[1] == Approx(0.981).epsilon(0.01));
  const auto error = [](const std::string& ends) { TestScene{scene(bar(0), "{type: rope, name: r, " + ends + ", stiffness: 1}")}; };
  CHECK_THROWS_WITH(error("from: {object: bar_0}, to: {at: [0, 1, 0]}"), Contains("give the place of the end"));
  CHECK_THROWS_WITH(error("from: {at: [0, 0, 0]}, to: {select: {type: all}}"), Contains("chooses vertices of an `object`"));
}
