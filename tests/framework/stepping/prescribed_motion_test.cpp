// Prescribed surfaces: releasing, pushing, and their reaction forces.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

#include "framework/contact/terms/contact_term.hpp"
#include "geometry/errors.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

Vec3 momentum(const TestRun& run) {
  Vec3 sum = Vec3::Zero();
  for (int v = 0; v < run.world->mass.size(); ++v) sum += run.world->mass(v) * vertex(run.state().v, v);
  return sum;
}

double front_of(const TestRun& run, int body) {
  double front = -1e9;
  for (int v = 0; v < run.world->bodies[body].vertex_count; ++v)
    front = std::max(front, run.at(run.world->bodies[body].first_vertex + v).x());
  return front;
}

// A plate that meets a block at x = 0 and drives it along x.
std::string plate_and_block(const std::string& time, const std::string& motion, const std::string& block_motion) {
  return time + fmt::format(
      "solver: {{type: projected_newton, tolerance: 1e-4}}\n"
      "objects:\n"
      "  - {{name: plate, shape: {{type: box, size: [0.02, 0.2, 0.2]}}, place: {{translate: [-0.0155, 0, 0]}},\n"
      "     motion: [{}]}}\n"
      "  - {{name: block, shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}},\n"
      "     place: {{translate: [0.05, 0, 0]}}, motion: [{}],\n"
      "     energies: [{{type: neo_hookean, young: 1e5, poisson: 0, density: 1000}}]}}\n"
      "contact: {{distance: 1 mm}}\n"
      "probes: [{{name: drive, type: reaction, object: plate}}]\n", motion, block_motion);
}

std::string thrown(double until) {
  return fmt::format("objects: [{{name: block, shape: {{type: box, size: [0.1, 0.1, 0.1]}},\n"
                     "  energies: [{{type: neo_hookean, young: 1e5}}],\n"
                     "  motion: [{{type: translate, velocity: [0.3, 0.2, 0], until: {}}}]}}]\n", until);
}

}  // namespace

TEST_CASE("released vertices keep their velocity: free flight is exact") {
  const std::string integrator = GENERATE("implicit_euler", "bdf2", "newmark");
  const double until = GENERATE(0.05, 0.057);  // between two steps, too
  INFO(integrator << ", until " << until);
  TestRun run(fmt::format("time: {{step: 0.01, duration: 1, integrator: {}}}\n", integrator) + thrown(until));
  CHECK(run.world->dofs.size() == 0);
  for (int i = 1; i <= 12; ++i) {
    run.step();
    for (int v = 0; v < 8; ++v) {
      CHECK((run.at(v) - run.rest(v) - 0.01 * i * Vec3(0.3, 0.2, 0)).norm() <= 1e-12);
      CHECK((vertex(run.state().v, v) - Vec3(0.3, 0.2, 0)).norm() <= 1e-10);
    }
  }
  CHECK(run.world->dofs.size() == 24);
}

TEST_CASE("released vertices fall by the formula of each integrator") {
  const std::string integrator = GENERATE("implicit_euler", "newmark");
  INFO(integrator);
  TestRun run(fmt::format("gravity: [0, -10, 0]\ntime: {{step: 0.01, duration: 1, integrator: {}}}\n", integrator) +
                 thrown(0.05));
  for (int i = 0; i < 12; ++i) run.step();
  const int n = 7;  // steps in flight
  const double fallen = integrator == "newmark" ? 10 * 0.07 * 0.07 / 2 : 10 * 1e-4 * n * (n + 1) / 2.0;
  for (int v = 0; v < 8; ++v)
    CHECK((run.at(v) - run.rest(v) - Vec3(0.12 * 0.3, 0.12 * 0.2 - fallen, 0)).norm() <= 1e-10);
}

TEST_CASE("a plate that moves ten contact distances a step pushes a block ahead") {
  TestRun run(plate_and_block("time: {step: 0.01, duration: 1}\n", "{type: translate, velocity: [1, 0, 0]}", ""));
  Vec3 impulse = Vec3::Zero();
  for (int i = 1; i <= 10; ++i) {
    const StepReport report = run.step();
    const auto force = run.sample(0);
    impulse += report.step_size * Vec3(force[0], force[1], force[2]);
    CHECK(report.min_distance > 0);
    CHECK(front_of(run, 0) == Approx(-0.0055 + 0.01 * i).margin(1e-14));
  }
  CHECK(front_of(run, 1) > 0.15);
  CHECK_FALSE(run.intersects());
  // The plate has no mass: its impulse is that of the block, of 1 kg and at least as fast as the plate.
  CHECK(momentum(run).x() > 0.9);
  CHECK((impulse - momentum(run)).norm() < 0.01 * momentum(run).x());
  CHECK(run.warnings.empty());
}

TEST_CASE("pushing works without inertia") {
  TestRun run(plate_and_block("time: {step: 0.1, duration: 1, integrator: quasi_static}\n",
                                 "{type: translate, velocity: [0.1, 0, 0]}",
                                 "{type: fixed, select: {type: face, direction: [1, 0, 0]}}"));
  for (int i = 1; i <= 5; ++i) {
    CHECK(run.step().min_distance > 0);
    CHECK(front_of(run, 0) == Approx(-0.0055 + 0.01 * i).margin(1e-14));
  }
  // The force is A mu (1/a - a), with a gap between zero and the contact distance.
  CHECK(run.sample(0)[0] > 623.4);
  CHECK(run.sample(0)[0] < 644.9);
  CHECK(run.warnings.empty());
}

TEST_CASE("a blocked prescribed motion is reported by name") {
  const auto check_error = [](const std::string& scene, const std::string& message) {
    TestRun run(scene);
    const auto ahead = [&] { while (!run.stepper.finished()) run.step(); };
    CHECK_THROWS_AS(ahead(), SimulationError);
    const double reached = run.state().time;
    CHECK_THROWS_WITH(run.step(), Catch::Contains(message));
    CHECK(run.state().time == reached);  // the last good state stays
    if (!run.world->contact) return;
    CHECK_FALSE(run.intersects());
  };
  // onto the fixed wall
  check_error("time: {step: 0.01, duration: 0.1, max_cutbacks: 3}\n"
       "objects:\n"
       "  - {name: wall, shape: {type: box, size: [0.02, 0.2, 0.2]}, motion: [fixed]}\n"
       "  - {name: plate, shape: {type: box, size: [0.02, 0.1, 0.1]}, place: {translate: [-0.04, 0, 0]},\n"
       "     motion: [{type: translate, velocity: [1, 0, 0]}]}\n"
       "  - {name: far, shape: {type: box, size: [0.02, 0.1, 0.1]}, place: {translate: [3, 0, 0]},\n"
       "     energies: [{type: neo_hookean, young: 1e5}]}\n"
       "contact: {distance: 1 mm}\n",
       "the prescribed motion drives 'plate' into 'wall': vertex ");
  // through a block that cannot move away
  check_error(plate_and_block("time: {step: 0.5, duration: 1, integrator: quasi_static, max_cutbacks: 0}\n",
                       "{type: translate, velocity: [0.25, 0, 0]}",
                       "{type: fixed, select: {type: face, direction: [1, 0, 0]}}"),
       "the prescribed motion drives 'plate' into 'block': vertex ");
  // deforming its own elements
  check_error("time: {step: 0.1, duration: 1, max_cutbacks: 2}\n"
       "objects: [{name: bar, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 1, 1]},\n"
       "  energies: [{type: neo_hookean, young: 1e5}],\n"
       "  motion: [{type: fixed, select: {type: face, direction: [-1, 0, 0]}},\n"
       "    {type: translate, velocity: [-1, 0, 0], select: {type: face, direction: [1, 0, 0]}}]}]\n",
       "the prescribed motion deforms 'bar' too far: vertex ");
}

TEST_CASE("the force that compresses a bar is that of its material") {
  // Short enough not to buckle.
  TestRun run("time: {step: 0.1, duration: 1, integrator: quasi_static}\n"
                 "solver: {type: projected_newton, force_tolerance: 1e-10}\n"
                 "objects: [{name: bar, shape: {type: box, size: [0.15, 0.1, 0.1], cells: [3, 2, 2]},\n"
                 "  energies: [{type: neo_hookean, young: 1e5, poisson: 0}],\n"
                 "  motion: [{type: fixed, select: {type: face, direction: [-1, 0, 0]}},\n"
                 "    {type: translate, velocity: [-0.06, 0, 0], select: {type: face, direction: [1, 0, 0]}}]}]\n"
                 "probes:\n"
                 "  - {name: driven, type: reaction, object: bar, select: {type: face, direction: [1, 0, 0]}}\n"
                 "  - {name: fixed, type: reaction, object: bar, select: {type: face, direction: [-1, 0, 0]}}\n");
  for (int i = 1; i <= 10; ++i) {
    run.step();
    const double a = 1 - 0.006 * i / 0.15, force = 1e5 / 2 * 0.01 * (a - 1 / a);  // A mu (a - 1/a)
    CHECK(run.sample(0)[0] == Approx(force).epsilon(1e-7));
    CHECK(run.sample(1)[0] == Approx(-force).epsilon(1e-7));
  }
}

TEST_CASE("the impulse of prescribed vertices is the momentum that their body gains") {
  const std::string integrator = GENERATE("implicit_euler", "newmark", "bdf2");
  TestRun run(fmt::format("time: {{step: 0.002, duration: 1, integrator: {}}}\n", integrator) +
                 "solver: {type: projected_newton, tolerance: 1e-7}\n"
                 "objects: [{name: bar, shape: {type: box, size: [0.5, 0.1, 0.1], cells: [5, 2, 2]},\n"
                 "  energies: [{type: neo_hookean, young: 1e5, density: 1000}],\n"
                 "  motion: [{type: formula, x: 5 * t^2, select: {type: face, direction: [1, 0, 0]}}]}]\n"
                 "probes: [{name: drive, type: reaction, object: bar, select: {type: face, direction: [1, 0, 0]}}]\n");
  Vec3 impulse = Vec3::Zero();
  for (int i = 0; i < 50; ++i) {
    const StepReport report = run.step();
    const auto force = run.sample(0);
    impulse += report.step_size * Vec3(force[0], force[1], force[2]);
  }
  INFO(integrator << ": " << impulse.x() << " N s, " << momentum(run).x());
  const double within = integrator == "implicit_euler" ? 1e-5 : 0.05;  // sums over steps are of first order
  CHECK((impulse - momentum(run)).norm() < within * momentum(run).norm());
  CHECK(momentum(run).x() > 3);
}

TEST_CASE("no force between fixed primitives, no candidates within a rigid group") {
  TestRun run("time: {step: 0.01, duration: 1}\n"
                 "objects: [{name: sheet, shape: {type: box, size: [0.1, 0.0005, 0.1], cells: [6, 1, 6]},\n"
                 "  energies: [{type: neo_hookean, young: 1e5}],\n"
                 "  motion: [{type: rotate, axis: [1, 0, 0], angular_velocity: 1, select: {type: plane, point: [0.01, 0, 0], normal: [1, 0, 0]}}]},\n"
                 " {name: floor, shape: {type: box, size: [0.2, 0.01, 0.2], cells: [4, 1, 4]},\n"
                 "  place: {translate: [0, -0.015, 0]}, motion: [fixed]}]\n"
                 "contact: {distance: 20 mm}\n");
  const ContactSystem& contact = *run.world->contact;
  const CollisionMesh& mesh = contact.surface().mesh;
  const auto is_fixed = [&](int v) { return run.world->dofs.block(v) < 0; };
  for (const auto& [p, t] : contact.candidates().point_triangle)
    CHECK_FALSE((mesh.vertex_object[p] == mesh.vertex_object[mesh.triangles[t][0]] && is_fixed(p) && is_fixed(mesh.triangles[t][0]) && is_fixed(mesh.triangles[t][1]) && is_fixed(mesh.triangles[t][2])));
  run.world->contact->begin_step({run.world->rest});
  run.world->contact->move_to(run.world->rest);
  const auto all_have_a_free_vertex = [&](const auto& stencils) {
    for (const auto& s : stencils)
      CHECK(std::any_of(s.vertices.begin(), s.vertices.end(), [&](int v) { return !is_fixed(v); }));
  };
  CHECK(contact.contacts().size() > 10);
  all_have_a_free_vertex(contact.contacts().point_point);
  all_have_a_free_vertex(contact.contacts().point_edge);
  all_have_a_free_vertex(contact.contacts().point_triangle);
  all_have_a_free_vertex(contact.contacts().edge_edge);
}
