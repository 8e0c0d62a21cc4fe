// Solids that bend with few elements over the thickness, and that do not lock near a Poisson's
// ratio of 1/2, against beam theory and published results.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>
#include <map>

#include "framework/core/records.hpp"
#include "geometry/io/write_mesh.hpp"
#include "geometry/shapes/solids.hpp"
#include "geometry/tets/divide_tets.hpp"
#include "tests/support/program.hpp"
#include "tests/support/step_problem.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

constexpr double young = 1e6;  // Pa

// A bar of 10 x 1 x 1 m, clamped on the left, with 1 Pa down on the right.
std::string cantilever(const std::string& elements, int cells, double poisson) {
  return fmt::format("time: {{step: 1 s, duration: 1 s, integrator: quasi_static}}\nsolver: {{type: projected_newton, force_tolerance: 1e-7, linear: cholmod}}\n"
                     "objects:\n  - {{name: bar, shape: {{type: box, size: [10, 1, 1], cells: [{}, {}, {}]}}, elements: {},\n"
                     "     energies: [{{type: neo_hookean, young: {}, poisson: {}}}],\n"
                     "     motion: [{{type: fixed, select: {{type: face, direction: [-1, 0, 0]}}}}],\n"
                     "     loads: [{{type: traction, value: [0, -1, 0], select: {{type: face, direction: [1, 0, 0]}}}}]}}\n"
                     "probes: [{{name: tip, type: separation, direction: [0, 1, 0], from: {{object: bar, select: {{type: face, direction: [-1, 0, 0]}}}},\n"
                     "          to: {{object: bar, select: {{type: face, direction: [1, 0, 0]}}}}}}]\n",
                     10 * cells, cells, cells, elements, young, poisson);
}

double timoshenko(double poisson) { return 1000.0 / 3 / (young / 12) + 10 / (5.0 / 6 * young / (2 * (1 + poisson))); }

double tip(const std::string& elements, int cells, double poisson) {
  TestRun run(cantilever(elements, cells, poisson));
  run.step();
  return -run.sample(0)[0] / timoshenko(poisson);
}

// Cook's membrane in plane strain, cells x cells.
double cook(const std::string& elements, int cells, double poisson) {
  Mesh mesh = box_tets({1, 1, 1}, {cells, cells, 1});
  for (Vec3& x : mesh.vertices) {
    const double s = x.x() + 0.5, v = x.y() + 0.5;
    x = {48 * s, 44 * s + v * (44 - 28 * s), 48.0 / cells * (x.z() + 0.5)};
  }
  const TemporaryFolder folder;
  write_mesh(folder.path() / "cook.vtu", mesh);
  TestRun run(fmt::format("time: {{step: 1 s, duration: 4 s, integrator: quasi_static}}\nsolver: {{type: projected_newton, linear: cholmod}}\n"
                          "objects:\n  - name: it\n    shape: {{type: file, path: {}}}\n    elements: {}\n"
                          "    energies: [{{type: neo_hookean, young: 240.565, poisson: {}}}]\n"
                          "    motion: [{{type: fixed, select: {{type: face, direction: [-1, 0, 0]}}}}, {{type: fixed, along: [0, 0, 1]}}]\n"
                          "    loads: [{{type: traction, value: [0, 6.25, 0], ramp: [[0, 0], [4, 1]], select: {{type: face, direction: [1, 0, 0]}}}}]\n"
                          "probes: [{{name: tip, type: separation, direction: [0, 1, 0], from: {{object: it, select: {{type: face, direction: [-1, 0, 0]}}}},\n"
                          "          to: {{object: it, select: {{type: box, min: [47.9, 59.9, -1], max: [48.1, 60.1, 100]}}}}}}]\n",
                          (folder.path() / "cook.vtu").string(), elements, poisson));
  const double before = run.sample(0)[0];
  for (int i = 0; i < 4; ++i) run.step();
  return run.sample(0)[0] - before;
}

}  // namespace

TEST_CASE("locking: a cantilever with one composite cell over its depth bends as a beam does", "[locking]") {
  for (const double poisson : {0.3, 0.49, 0.4999}) {
    INFO("poisson " << poisson);
    CHECK(tip("composite", 1, poisson) == Approx(1).epsilon(0.03));
    CHECK(tip("linear", 1, poisson) < 0.25);  // it locks
  }
  CHECK(tip("composite", 2, 0.4999) > 0.95);
}

TEST_CASE("locking: patches prevent volumetric locking of linear tets", "[locking]") {
  CHECK(tip("patches", 2, 0.4999) == Approx(tip("patches", 2, 0.3)).epsilon(0.02));
  CHECK(tip("patches", 2, 0.4999) == Approx(0.607).epsilon(0.02));  // of an independent implementation
  CHECK(tip("linear", 2, 0.4999) < 0.02);
  CHECK(cook("patches", 8, 0.4999) == Approx(5.77).epsilon(0.02));  // of an independent implementation
}

TEST_CASE("locking: patches of meshes without cells are free of volumetric locking", "[locking]") {
  // The tets of a divided bar in an order that does not show the cells.
  Mesh mesh = divide_tets(box_tets({10, 1, 1}, {10, 1, 1}));
  std::vector<Tet> tets;
  for (size_t first = 0; first < 7; ++first)
    for (size_t t = first; t < mesh.tets.size(); t += 7) tets.push_back(mesh.tets[t]);
  mesh.tets = tets;
  const TemporaryFolder folder;
  write_mesh(folder.path() / "bar.vtu", mesh);
  const auto tip_of = [&](const std::string& elements) {
    std::string scene = cantilever(elements, 1, 0.4999);
    const std::string box = "{type: box, size: [10, 1, 1], cells: [10, 1, 1]}";
    scene.replace(scene.find(box), box.size(), "{type: file, path: " + (folder.path() / "bar.vtu").string() + "}");
    TestRun run(scene);
    run.step();
    return -run.sample(0)[0] / timoshenko(0.4999);
  };
  CHECK(tip_of("linear") < 0.05);
  CHECK(tip_of("patches") > 0.5);
}

TEST_CASE("locking: the pressure in a bent bar of composite tets is that of a beam", "[locking]") {
  for (const double poisson : {0.3, 0.4999}) {
    TestRun run(cantilever("composite", 2, poisson));
    run.step();
    const std::vector<Tet>& tets = run.world->bodies[0].tets;
    const std::vector<Mat3> stress = run.world->records.stresses()[0].values(run.state().x);
    double error = 0, size = 0;
    for (size_t t = 0; t < tets.size(); t += 8) {
      double pressure = 0;
      Vec3 middle = Vec3::Zero();
      for (size_t s = t; s < t + 8; ++s) {
        pressure += stress[s].trace() / 3 / 8;
        for (const int v : tets[s]) middle += run.rest(v) / 32;
      }
      if (std::abs(middle.x()) > 3) continue;
      const double expected = (5 - middle.x()) * middle.y() * 12 / 3;
      error += std::pow(pressure - expected, 2);
      size += std::pow(expected, 2);
    }
    INFO("poisson " << poisson << ", error " << std::sqrt(error / size));
    CHECK(std::sqrt(error / size) < 0.2);
  }
}

TEST_CASE("locking: Cook's membrane of eight composite cells", "[locking]") {
  // References: limits of meshes of composite tets, up to 32 cells.
  CHECK(cook("composite", 8, 0.3) == Approx(7.78).epsilon(0.03));
  CHECK(cook("composite", 8, 0.4999) == Approx(6.93).epsilon(0.03));
}

TEST_CASE("locking: a bar of two composite cells over its depth is bent plastically with the moment of a beam", "[locking][plasticity]") {
  // The ends rotate to three times the curvature at yield: M = 1.5 M_y (1 - 1/27), M_y = sigma b h^2 / 6.
  const double yield_stress = 200, angle = 3 * (2 * yield_stress / young) * 4 / 2;
  const std::string turn = "motion: [{type: rotate, axis: [0, 0, 1], centre: [-2, 0, 0], angle: " + std::to_string(-angle) +
                           ", duration: 12 s, select: {type: face, direction: [-1, 0, 0]}},\n"
                           "              {type: rotate, axis: [0, 0, 1], centre: [2, 0, 0], angle: " + std::to_string(angle) +
                           ", duration: 12 s, select: {type: face, direction: [1, 0, 0]}}]\n";
  const auto moment = [&](const std::string& elements) {
    TestRun run(fmt::format("time: {{step: 1 s, duration: 12 s, integrator: quasi_static}}\nsolver: {{type: projected_newton, linear: cholmod}}\n"
                            "objects:\n  - name: bar\n    shape: {{type: box, size: [4, 1, 1], cells: [8, 2, 2]}}\n    elements: {}\n"
                            "    energies: [{{type: von_mises, young: {}, poisson: 0.3, yield_stress: {}}}]\n    {}"
                            "probes: [{{name: moment, type: torque, object: bar, centre: [2, 0, 0], direction: [0, 0, 1], select: {{type: face, direction: [1, 0, 0]}}}}]\n",
                            elements, young, yield_stress, turn));
    for (int i = 0; i < 12; ++i) run.step();
    return run.sample(0)[0] / (yield_stress / 6);
  };
  CHECK(moment("composite") == Approx(1.5 * (1 - 1.0 / 27)).epsilon(0.03));
}

TEST_CASE("locking: a block of composite tets is compressed to two fifths without step cutbacks", "[locking]") {
  TestRun run("time: {step: 1 s, duration: 24 s, integrator: quasi_static}\nsolver: {type: projected_newton, linear: cholmod, max_iterations: 150}\n"
              "objects:\n  - name: cube\n    shape: {type: box, size: [1, 1, 1], cells: [2, 2, 2]}\n    elements: composite\n"
              "    energies: [{type: neo_hookean, young: 1, poisson: 0.49}]\n"
              "    motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}},\n"
              "             {type: translate, velocity: [0, -0.025, 0], select: {type: face, direction: [0, 1, 0]}}]\n"
              "probes: [{name: push, type: reaction, object: cube, direction: [0, -1, 0], select: {type: face, direction: [0, 1, 0]}}]\n");
  std::map<int, double> expected = {{12, 0.528}, {20, 1.11}, {24, 1.52}};  // of an independent implementation
  for (int i = 1; i <= 24; ++i) {
    REQUIRE(run.step().rejections.cutbacks() == 0);
    if (expected.contains(i)) CHECK(run.sample(0)[0] == Approx(expected[i]).epsilon(0.02));
  }
}

TEST_CASE("locking: an even pressure of a block of composite tets on a floor is even at every vertex", "[locking][contact]") {
  // The contact is a hundred times as stiff as the block: k h / E.
  TestRun run("time: {step: 1 s, duration: 1 s, integrator: quasi_static}\nsolver: {type: projected_newton, linear: cholmod, stopping: force, force_tolerance: 1e-11}\n"
              "objects:\n  - {name: floor, shape: {type: box, size: [3, 1, 3]}, motion: [fixed]}\n"
              "  - name: cube\n    shape: {type: box, size: [1, 1, 1], cells: [2, 2, 2]}\n    place: {translate: [0, 1.00003, 0]}\n    elements: composite\n"
              "    energies: [{type: neo_hookean, young: 1e5, poisson: 0}]\n"
              "    motion: [{type: fixed, across: [0, 1, 0]}]\n"
              "    loads: [{type: traction, value: [0, -100, 0], select: {type: face, direction: [0, 1, 0]}}]\n"
              "contact: {distance: 5e-5, barrier: {type: clamped_log, stiffness: 84}}\n");
  run.step();
  double lowest = 1, highest = 0;
  for (int v = run.world->bodies[1].first_vertex; v < run.world->mesh_vertex_count(); ++v)
    if (run.rest(v).y() < 0.5001) {
      lowest = std::min(lowest, run.at(v).y() - 0.5);
      highest = std::max(highest, run.at(v).y() - 0.5);
    }
  CHECK(lowest > 1e-5);
  CHECK(highest - lowest < 1e-10 * highest);
}

TEST_CASE("locking: Hessians of composite tets have at most two and a half times the entries of linear tets with the same vertices", "[locking]") {
  const auto blocks = [](const std::string& elements, int cells) {
    StepProblem step(cantilever(elements, cells, 0.3));
    step.potential.move_to(step.q);
    return step.potential.hessian({Projection::clamp}).row.size();
  };
  CHECK(blocks("composite", 2) < 2.5 * blocks("linear", 4));
}
