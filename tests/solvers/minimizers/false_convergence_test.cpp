// Scenes in which a point looks like the minimum and is not: a direction is short because it is wrong, or
// because a stiff force moves nothing far.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "geometry/errors.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

double vertical_velocity(const TestRun& s, const std::string& object) {
  const Body& body = s.world->bodies[s.world->body_index(object)];
  double momentum = 0, mass = 0;
  for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) {
    momentum += s.world->mass(v) * vertex(s.state().v, v).y();
    mass += s.world->mass(v);
  }
  return momentum / mass;
}

// One box hits the floor hard while another falls freely, far above it.
std::string two_boxes(const std::string& solver) {
  return "time: {step: 10 ms, duration: 10 ms, max_cutbacks: 0}\ngravity: [0, -9.81, 0]\nsolver: " + solver + R"(
objects:
  - {name: floor, shape: {type: box, size: [2, 0.1, 2]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}
  - name: hits
    shape: {type: box, size: [0.1, 0.1, 0.1], cells: [4, 4, 4]}
    place: {translate: [0, 0.052, 0]}
    velocity: [0, -10, 0]
    energies: [{type: neo_hookean, young: 1e5, poisson: 0.4, density: 1000}]
  - name: falls
    shape: {type: box, size: [0.1, 0.1, 0.1], cells: [4, 4, 4]}
    place: {translate: [0.3, 5.05, 0]}
    energies: [{type: neo_hookean, young: 1e6, poisson: 0.4, density: 1000}]
contact: {distance: 1 mm}
)";
}

// A block of 8 t falls on one of 80 g, which is no obstacle to it.
std::string heavy_on_light(const std::string& type) {
  return "time: {step: 10 ms, duration: 60 ms}\ngravity: [0, -9.81, 0]\nsolver: {type: " + type +
         ", max_iterations: 20000}\n" + R"(
objects:
  - {name: floor, shape: {type: box, size: [2, 0.1, 2]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}
  - name: light
    shape: {type: box, size: [0.2, 0.2, 0.2]}
    place: {translate: [0, 0.11, 0]}
    energies: [{type: neo_hookean, young: 1e5, poisson: 0.4, density: 10}]
  - name: heavy
    shape: {type: box, size: [0.2, 0.2, 0.2]}
    place: {translate: [0, 0.35, 0]}
    energies: [{type: neo_hookean, young: 1e6, poisson: 0.4, density: 1e6}]
contact: {distance: 1 mm}
)";
}

// 157 N of weight, a picometre above the floor: the barrier starts with 7e12 N.
const std::string picometre = R"(
time: {step: 1 ms, duration: 10 ms, max_cutbacks: 0}
gravity: [0, -9.81, 0]
objects:
  - {name: floor, shape: {type: box, size: [1, 0.05, 1]}, place: {translate: [0, -0.025, 0]}, motion: [fixed]}
  - name: block
    shape: {type: box, size: [0.2, 0.2, 0.2], cells: [3, 3, 3]}
    place: {translate: [0, 0.100000000001, 0]}
    energies: [{type: neo_hookean, young: 1e5, poisson: 0.4, density: 2000}]
contact: {distance: 1 mm}
probes: [{name: push, type: contact_force, on: block, direction: [0, 1, 0]}]
)";

// A cube of a micrometre that is thrown at the floor at 5 mm/s.
std::string micrometre(const std::string& solver) {
  return "time: {step: 1 us, duration: 20 us}\nsolver: " + solver + R"(
objects:
  - {name: floor, shape: {type: box, size: [4e-6, 1e-6, 4e-6]}, place: {translate: [0, -0.5e-6, 0]}, motion: [fixed]}
  - name: cube
    shape: {type: box, size: [1e-6, 1e-6, 1e-6], cells: [3, 3, 3]}
    place: {translate: [0, 0.52e-6, 0]}
    velocity: [0, -5e-3, 0]
    energies: [{type: neo_hookean, young: 1e3, poisson: 0.4, density: 1000}]
contact: {distance: 1e-8}
)";
}

}  // namespace

TEST_CASE("a stiff impact does not hide a body that falls freely", "[minimizer]") {
  for (const char* solver :
       {"{type: projected_newton}", "{type: projected_newton, linear: lagged_cholesky}",
        "{type: projected_newton, linear: {type: pcg, tolerance: 0.1}}", "{type: newton_pcg}",
        "{type: projected_newton, linear: {type: lagged_cholesky, tolerance: 0.5, max_iterations: 50}}"}) {
    INFO(solver);
    TestRun s(two_boxes(solver));
    CHECK(s.step().converged);
    CHECK(vertical_velocity(s, "falls") == Approx(-0.0981).margin(0.01));  // 1 cm/s: the default tolerance
  }
}

TEST_CASE("a heavy block does not stop in mid-air with any minimiser", "[minimizer]") {
  for (const std::string& type : Registry<Minimizer>::kind().names()) {
    INFO(type);
    TestRun s(heavy_on_light(type));
    while (!s.stepper.finished()) s.step();
    CHECK(vertical_velocity(s, "heavy") == Approx(-0.5886).margin(0.01));
  }
}

TEST_CASE("a start at a picometre from the minimum does not end with an unbalanced force", "[minimizer]") {
  for (const std::string& type : Registry<Minimizer>::kind().names()) {
    INFO(type);
    TestRun s(picometre + "solver: {type: " + type + ", max_iterations: 100, balance_tolerance: 0.01}\n");
    CHECK(s.sample(0)[0] > 5e11);
    const bool newton = type == "projected_newton" || type == "newton_pcg";
    for (int i = 0; i < (newton ? 3 : 1); ++i) {
      StepReport r;
      try {
        r = s.step();
      } catch (const SimulationError&) {
        CHECK_FALSE(newton);  // others may fail, but not say that they have not
        break;
      }
      CHECK(r.tolerated_force < 10);
      CHECK(r.unbalanced_force <= r.tolerated_force);
      CHECK(s.sample(0)[0] < 1e4);
    }
  }
}

TEST_CASE("a scene of a micrometre is solved as well as one of a metre", "[minimizer]") {
  for (const char* type : {"projected_newton", "lbfgs"}) {
    INFO(type);
    TestRun s(micrometre(std::string("{type: ") + type + "}"));
    TestRun exact(micrometre("{type: projected_newton, tolerance: 1e-9}"));
    CHECK(s.config.solver->velocity_tolerance() == Approx(1e-3));  // a tenth of the contact distance in a step
    for (int i = 0; i < 20; ++i) {
      s.step();
      exact.step();
      CHECK(vertical_velocity(s, "cube") == Approx(vertical_velocity(exact, "cube")).margin(1e-3));
    }
    CHECK(vertical_velocity(exact, "cube") > 5e-4);  // it has bounced
  }
}

// The bar hangs on one vertex and turns freely about it: its Hessian is singular, and round-off decides whether it is definite.
TEST_CASE("a quasi-static body without stress is at rest with any minimiser", "[minimizer]") {
  const double angle = GENERATE(0.3, 0.5, 0.7, 1.2, 1.5);
  for (const std::string& type : Registry<Minimizer>::kind().names()) {
    INFO(type << ", turned by " << angle);
    TestRun s("time: {step: 10 ms, duration: 20 ms, integrator: quasi_static, max_cutbacks: 0}\n"
                 "solver: {type: " + type + "}\n"
                 "objects: [{name: bar, shape: {type: box, size: [0.2, 0.1, 0.1], cells: [4, 3, 3]},\n"
                 "  place: {axis: [1, 2, 3], angle: " + fmt::to_string(angle) + ", translate: [0.3, 0.1, 0.77]},\n"
                 "  energies: [{type: neo_hookean, young: 1e5, poisson: 0.4, density: 1000}],\n"
                 "  motion: [{type: fixed, select: {type: face, direction: [-1, 0, 0]}}]}]\n");
    for (int i = 0; i < 2; ++i) CHECK(s.step().converged);
    CHECK((s.state().x - s.world->rest).lpNorm<Eigen::Infinity>() < 1e-12);
  }
}
