// Bodies that are moved between steps: every integrator, with friction, with bonds, with adhesion.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/stepping/time_integrator.hpp"
#include "geometry/errors.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

struct Acting {
  const char* name;
  const char* contact;  // how they act on each other
};
const Acting all_acting[] = {
    {"nothing", ""},
    {"friction", "friction: {mu: 0.5}"},
    {"bonds", "adhesion: {type: rcc, normal_stiffness: 1e7, tangential_stiffness: 4e6, work_of_adhesion: 0.5}, bond_distance: 0.95 mm"},
    {"adhesion", "adhesion: {type: fang, peak_traction: 2 kPa, peak_distance: 0.6 mm, range: 0.85 mm}, tangential_adhesion: {mu: 0.3}"}};

// A cube 0.9 mm above a plate, beyond all forces, thrown at it and along it.
std::string thrown(const std::string& integrator, const Acting& acting, const std::string& body) {
  const std::string contact = *acting.contact ? fmt::format("contact:\n  distance: 0.5 mm\n  pairs: [{{between: [cube, plate], {}}}]\n", acting.contact) : "";
  return fmt::format(
             "time: {{step: 2 ms, duration: 1, integrator: {}}}\n"
             "solver: {{type: projected_newton, tolerance: 1e-7, force_floor: 1e-9}}\n"
             "objects:\n"
             "  - {{name: plate, shape: {{type: box, size: [0.4, 0.02, 0.2], cells: [2, 1, 1]}}, place: {{translate: [0, -0.01, 0]}}, motion: [fixed]}}\n"
             "  - {{name: cube, shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}}, place: {{translate: [0, 0.0509, 0]}}, velocity: [0.3, -0.6, 0],\n"
             "     {}}}\n",
             integrator, body) +
         contact;
}
const std::string elastic = "energies: [{type: neo_hookean, young: 1e5, density: 1000}]", affine = "body: {type: affine, density: 1000}";

VecX of_meshes(const World& world, const VecX& field) { return field.head(3 * world.mesh_vertex_count()); }

template <class Check>
void for_each_scene(const Check& check) {
  for (const std::string& integrator : Registry<TimeIntegrator>::kind().names())
    for (const Acting& acting : all_acting)
      for (const std::string& body : {elastic, affine}) {
        INFO(integrator << ", " << acting.name << ", " << body);
        check(integrator, acting, body);
      }
}

}  // namespace

TEST_CASE("a move to where everything is changes no bit", "[move]") {
  for_each_scene([](const std::string& integrator, const Acting& acting, const std::string& body) {
    TestRun moved(thrown(integrator, acting, body)), left(thrown(integrator, acting, body));
    for (int i = 0; i < 6; ++i) {
      moved.simulation.move(of_meshes(*moved.world, moved.state().x), of_meshes(*moved.world, moved.state().v));
      moved.simulation.step();
      left.simulation.step();
    }
    CHECK(moved.state().x == left.state().x);
    CHECK(moved.state().v == left.state().v);
  });
}

TEST_CASE("a body put back to its rest state stays at rest", "[move]") {
  for_each_scene([](const std::string& integrator, const Acting& acting, const std::string& body) {
    TestRun run(thrown(integrator, acting, body));
    const VecX rest = of_meshes(*run.world, run.world->rest), still = VecX::Zero(rest.size());
    for (int i = 0; i < 6; ++i) run.simulation.step();
    if (integrator != "quasi_static") CHECK((run.state().x - run.world->rest).lpNorm<Eigen::Infinity>() > 1e-4);
    run.simulation.move(rest, still);
    double largest = 0;
    for (int i = 0; i < 4; ++i) {
      run.simulation.step();
      largest = std::max(largest, run.state().v.lpNorm<Eigen::Infinity>());
    }
    CHECK(largest <= 1e-8);
    CHECK((run.state().x - run.world->rest).lpNorm<Eigen::Infinity>() <= 1e-9);
  });
}

TEST_CASE("a moved simulation continues as a run that starts there", "[move]") {
  for (const std::string& integrator : Registry<TimeIntegrator>::kind().names()) {
    if (integrator == "quasi_static") continue;  // a free body has no unique equilibrium
    // Steps that are repeated for their energy here stay smaller for a while, also after a move.
    if (integrator == "sdirk2" || integrator == "documented_sdirk3") continue;
    INFO(integrator);
    const Acting& friction = all_acting[1];
    TestRun moved(thrown(integrator, friction, elastic)), fresh(thrown(integrator, friction, elastic));
    for (int i = 0; i < 5; ++i) moved.simulation.step();
    // Stretched, off the plate.
    const Body& cube = moved.world->bodies[1];
    VecX stretched = of_meshes(*moved.world, moved.world->rest);
    for (int v = cube.first_vertex; v < cube.first_vertex + cube.vertex_count; ++v) stretched(3 * v) *= 1.02, stretched(3 * v + 1) += 0.01;
    for (TestRun* run : {&moved, &fresh}) run->simulation.move(stretched, VecX::Zero(stretched.size()));
    const double begun = moved.state().time;
    for (int i = 0; i < 5; ++i) moved.simulation.step(), fresh.simulation.step();
    CHECK((moved.state().x - fresh.state().x).lpNorm<Eigen::Infinity>() <= 1e-10);
    CHECK(moved.state().time - begun == Approx(fresh.state().time));
  }
}

TEST_CASE("moves that cannot be are refused, and leave everything as it was", "[move]") {
  TestRun run(thrown("newmark", all_acting[1], affine)), left(thrown("newmark", all_acting[1], affine));
  for (TestRun* r : {&run, &left}) r->simulation.step();
  const VecX x = of_meshes(*run.world, run.state().x), v = of_meshes(*run.world, run.state().v);
  VecX bent = x, inside = x;
  const int first = run.world->bodies[1].first_vertex;
  bent(3 * first) += 1e-3;
  for (int i = first; i < bent.size() / 3; ++i) inside(3 * i + 1) -= 0.01;
  CHECK_THROWS_WITH(run.simulation.move(bent, v), Catch::Contains("vertex 0 of 'cube' follows others"));
  CHECK_THROWS_WITH(run.simulation.move(inside, v), Catch::Contains("intersects"));
  for (TestRun* r : {&run, &left}) r->simulation.step();
  CHECK(run.state().x == left.state().x);
}
