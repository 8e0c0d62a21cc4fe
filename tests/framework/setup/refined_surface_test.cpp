// Contact on a surface finer than that of the mesh: `surface: {edge_length: ...}`.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "framework/checks/derivative_check.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/profile/isolated_pair.hpp"
#include "geometry/errors.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;
using Catch::Contains;

namespace {

constexpr double dhat = 1e-3, side = 0.02;  // m

// A cube over the middle of a floor of one cell.
std::string cube_on_floor(int cells, const std::string& surface) {
  return fmt::format("objects:\n"
                     "  - {{name: cube, shape: {{type: box, size: [{0}, {0}, {0}], cells: [{1}, {1}, {1}]}}, {2}\n"
                     "     place: {{translate: [0, {3}, 0]}}, energies: [{{type: neo_hookean, young: 1e5}}]}}\n"
                     "  - {{name: floor, shape: {{type: box, size: [0.05, 0.01, 0.05]}}, {2}\n"
                     "     place: {{translate: [0, -0.005, 0]}}, motion: [fixed]}}\n"
                     "contact: {{distance: {4}, barrier: {{type: clamped_log, stiffness: 3e3}}}}\n",
                     side, cells, surface, side / 2 + dhat, dhat);
}

struct Contact {
  double energy;  // J
  Vec3 force;     // on the cube [N]
};

// Contact of the cube, sheared and tilted, with its lowest corner at a height above the floor.
Contact contact_of(const std::string& yaml, double tilt, double height) {
  TestScene scene(yaml);
  World& world = *scene.world;
  Mat3 map = Eigen::AngleAxisd(tilt, Vec3(0.3, 0, 1).normalized()).toRotationMatrix();
  map.row(0) += Eigen::RowVector3d(0.05, 0.1, 0);
  VecX x = world.rest;
  const Body& cube = world.bodies[0];
  double lowest = 1;
  for (int v = 0; v < cube.vertex_count; ++v) {
    vertex(x, v) = (map * vertex(world.rest, v)).eval();
    lowest = std::min(lowest, x(3 * v + 1));
  }
  for (int v = 0; v < cube.vertex_count; ++v) x(3 * v + 1) += height - lowest;
  world.dofs.update_dependents(x);
  world.contact->begin_step({x});
  world.contact->move_to(x);
  VecX forces = contact_term(world).forces(x, LawTerm::all);
  const Vec3 between = contact_term(world).force_between(x, LawTerm::all, {0, 1});
  world.collect_on_meshes(forces);
  Vec3 sum = Vec3::Zero();
  for (int v = 0; v < cube.vertex_count; ++v) sum += vertex(forces, v);
  CHECK((sum - between).norm() <= 1e-12 * between.norm());
  return {contact_term(world).value(x), sum};
}

double error_of(const Contact& a, const Contact& reference) {
  return std::max(std::abs(a.energy / reference.energy - 1), (a.force - reference.force).norm() / reference.force.norm());
}

// A body on a base of few triangles, both with finer surfaces.
std::string on_base(const std::string& shape_and_place, const std::string& material, const std::string& more = "") {
  return "time: {step: 5 ms, duration: 1 s}\ngravity: [0, -9.81, 0]\nobjects:\n"
         "  - {name: upper, shape: " + shape_and_place + ", surface: {edge_length: 7 mm}, " + material + "}\n"
         "  - {name: base, shape: {type: box, size: [6 cm, 4 cm, 6 cm]}, surface: {edge_length: 1 cm},\n"
         "     energies: [{type: neo_hookean, young: 1e5, density: 1000}],\n"
         "     motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}]}\n"
         "contact: {distance: 1 mm, friction: {mu: 0.3}}\n" + more;
}

const std::string soft = "energies: [{type: neo_hookean, young: 2e5, density: 1000}]";
const std::string affine = "body: {type: affine, density: 1000}";

}  // namespace

TEST_CASE("a finer surface gives the contact of a finer mesh in the same state", "[contact]") {
  for (const double tilt : {0.0, 2.0, 4.0}) {
    const double angle = tilt * M_PI / 180, height = 0.55e-3;  // above the range of guards
    const Contact fine = contact_of(cube_on_floor(24, ""), angle, height);
    const double coarse = error_of(contact_of(cube_on_floor(1, ""), angle, height), fine);
    const double finer = error_of(contact_of(cube_on_floor(1, "surface: {edge_length: 1.2 mm},"), angle, height), fine);
    INFO("tilt " << tilt << " degrees: error " << coarse << ", with the finer surface " << finer);
    CHECK(finer < 0.02);
    if (tilt > 0) CHECK(coarse > 10 * finer);
  }
}

TEST_CASE("derivatives of contact and friction on finer surfaces are right", "[contact][scene]") {
  for (const std::string& material : {soft, affine}) {
    TestScene scene(on_base("{type: sphere, radius: 2 cm, cells: 2}, place: {translate: [0, 4.03 cm, 0]}", material));
    for (const DerivativeCheck& c : check_derivatives(*scene.world, 0.005, scene.clock)) {
      INFO(c.term << ": " << c.gradient.error << ", " << c.hessian.error);
      CHECK_FALSE(c.wrong());
      if (c.term == "contact" || c.term == "friction") CHECK(c.active());
    }
  }
}

TEST_CASE("bodies with finer surfaces come to rest on each other and never meet", "[contact]") {
  for (const std::string& material : {soft, affine}) {
    TestRun run(on_base("{type: box, size: [2 cm, 2 cm, 2 cm]}, place: {translate: [0, 3.2 cm, 0], angle: 0.05, axis: [1, 0, 0.3]}",
                        material,
                        "probes:\n  - {name: force, type: contact_force, on: upper, from: base}\n"
                        "  - {name: all, type: contact_force, on: upper}\n"));
    const World& world = *run.world;
    CHECK(world.bodies[0].surface_vertices.size() > 20);
    while (run.state().time < 0.3) {
      const StepReport report = run.step();
      REQUIRE(report.converged);
      REQUIRE(report.intersections == 0);
      REQUIRE(report.min_distance > 0);
    }
    double weight = 0, fastest = 0;
    for (const int v : world.vertices_of(0)) {
      weight += 9.81 * world.mass(v);
      fastest = std::max(fastest, vertex(run.state().v, v).norm());
    }
    CHECK(fastest < 1e-5);
    CHECK(run.sample(0)[1] == Approx(weight).epsilon(1e-4));
    CHECK(run.sample(1)[1] == Approx(run.sample(0)[1]).epsilon(1e-9));
    // New vertices have the positions that follow from the corners.
    VecX x = run.state().x;
    world.dofs.update_dependents(x);
    CHECK((x - run.state().x).lpNorm<Eigen::Infinity>() < 1e-15);
    // The profile takes the pair with its finer surfaces out of the world.
    CHECK(isolate(world, {0, 1}, run.state()).count.stencils() > 0);
  }
}

TEST_CASE("a prescribed body moves its finer surface, as one rigid group", "[contact]") {
  TestRun run("time: {step: 5 ms, duration: 1 s}\nobjects:\n"
              "  - {name: plate, shape: {type: grid, size: [4 cm, 4 cm]}, surface: {edge_length: 1 cm},\n"
              "     motion: [{type: rotate, axis: [0, 1, 0], angular_velocity: 3}]}\n"
              "  - {name: cube, shape: {type: box, size: [1 cm, 1 cm, 1 cm]}, place: {translate: [0, 5 cm, 0]}, " + soft + "}\n"
              "contact: {distance: 1 mm}\n");
  const World& world = *run.world;
  const std::vector<int>& groups = world.contact->surface().mesh.vertex_group;
  REQUIRE(world.bodies[0].surface_vertices.size() > 4);
  for (int i = 0; i < 10; ++i) run.step();
  for (const int v : world.bodies[0].surface_vertices) {
    CHECK(groups[v] == groups[0]);
    const Vec3 there = Eigen::AngleAxisd(3 * run.state().time, Vec3::UnitY()) * run.rest(v);
    CHECK((run.at(v) - there).norm() < 1e-15);
    CHECK(world.prescribed_motion.may_move(v));
    CHECK_FALSE(world.prescribed_motion.ever_free(v));
  }
}

TEST_CASE("invalid finer surfaces are refused", "[contact][scene]") {
  CHECK_THROWS_WITH(TestScene(cube_on_floor(1, "surface: {edge_length: 1 um},")),
                    Contains("'cube' (surface.edge_length)") && Contains("ask for longer ones"));
  std::string text = cube_on_floor(1, "surface: {edge_length: 1 mm},");
  CHECK_THROWS_WITH(TestScene(text.substr(0, text.find("contact:"))), Contains("has a `surface` for contact, and there is none"));
  CHECK_THROWS_WITH(TestScene(cube_on_floor(1, "surface: {},")), Contains("edge_length"));
}
