// Overlap-boundary forces: the gradient of the energy with re-evaluated areas, without a net force
// or moment; everywhere W per length of the boundary.
#include "framework/contact/area_integral/overlap_boundary_term.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>
#include <random>

#include "tests/support/published.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

constexpr double side = 0.02, gap = 0.08e-3;  // m; a short range, so that overhangs are short

// Two plates one above the other, the upper one shifted along x and turned about y.
std::string plates(double shift, double angle, std::array<int, 2> cells, double lift = 0, const std::string& more = "", double peak_distance = 0.1e-3) {
  return fmt::format(
      "objects:\n"
      "  - {{name: upper, shape: {{type: box, size: [{0}, 0.005, {0}], cells: [{3}, 1, {3}]}},\n"
      "     place: {{axis: [0, 1, 0], angle: {2}, translate: [{1}, {5}, 0.00073]}}, energies: [{{type: neo_hookean, young: 2e7, density: 10}}]{6}}}\n"
      "  - {{name: lower, shape: {{type: box, size: [{0}, 0.005, {0}], cells: [{4}, 1, {4}]}}, place: {{translate: [0, -0.0025, 0]}},\n"
      "     energies: [{{type: neo_hookean, young: 2e7, density: 10}}]}}\n"
      "contact:\n  distance: 0.05 mm\n"
      "  pairs: [{{between: [upper, lower], adhesion: {{type: fang, peak_traction: 1000, peak_distance: {7}, range: {8}}}}}]\n",
      side, shift, angle, cells[0], cells[1], 0.0025 + gap + lift, more, peak_distance, 2 * peak_distance);
}

struct Places {
  explicit Places(const std::string& yaml) : scene(yaml), world(*scene.world) {}
  void begin(const VecX& x) {
    world.participants.begin_step({x, 0, 1e-3});
    world.participants.move_to(x);
  }
  // With the areas at x.
  double energy(const VecX& x) {
    begin(x);
    return contact_term(world).value(x);
  }
  VecX forces(const VecX& x) {
    begin(x);
    VecX sum = contact_term(world).forces(x, LawTerm::all);
    return sum + overlap_boundary_forces(world, x);
  }
  double depth() const { return -world.contact->pairs().laws(LawTerm::all)[world.contact->pairs().point(0, 1).law].at(gap).value; }

  TestScene scene;
  World& world;
};

VecX random_direction(Eigen::Index n) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> component(-1, 1);
  return VecX::NullaryExpr(n, [&] { return component(generator); });
}

}  // namespace

TEST_CASE("overlap boundary: the forces are minus the gradient of the energy with re-evaluated areas", "[contact][overlap_boundary]") {
  for (const auto& [shift, angle] : {std::pair(0.0043, 0.0), std::pair(0.0101, 0.3), std::pair(0.0017, 0.7)})
    for (const std::array<int, 2> cells : {std::array{6, 5}, std::array{2, 7}}) {
      Places p(plates(shift, angle, cells));
      const VecX x = p.world.rest, f = p.forces(x), d = random_direction(x.size());
      const double step = 1e-8;
      const double slope = (p.energy(x + step * d) - p.energy(x - step * d)) / (2 * step);
      INFO("shift " << shift << ", angle " << angle << ", cells " << cells[0] << " and " << cells[1]);
      CHECK(-f.dot(d) == Approx(slope).epsilon(2e-3).scale(p.depth() * side));
    }
}

TEST_CASE("overlap boundary: no net force and no moment", "[contact][overlap_boundary]") {
  Places p(plates(0.0072, 0.4, {6, 5}));
  p.begin(p.world.rest);
  const VecX f = overlap_boundary_forces(p.world, p.world.rest);
  REQUIRE(f.size() > 0);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  for (int v = 0; v < f.size() / 3; ++v) {
    sum += vertex(f, v);
    moment += Vec3(vertex(p.world.rest, v)).cross(Vec3(vertex(f, v)));
  }
  CHECK(sum.norm() < 1e-10 * f.norm());
  CHECK(moment.norm() < 1e-10 * side * f.norm());
}

TEST_CASE("overlap boundary: the lateral force is that of the energy per length, wherever the boundary runs", "[contact][overlap_boundary]") {
  for (const double shift : {0.0021, 0.0033334, 0.005, 0.0066, 0.008, 0.0101, 0.0163})
    for (const std::array<int, 2> cells : {std::array{6, 5}, std::array{3, 10}}) {
      Places p(plates(shift, 0, cells));
      p.begin(p.world.rest);
      INFO("shift " << shift << ", cells " << cells[0] << " and " << cells[1]);
      const double width = side - 0.00073;
      CHECK(overlap_boundary_force(p.world, p.world.rest, "adhesion", {0, 1}).x() == Approx(-p.depth() * width).epsilon(0.01));
      CHECK(overlap_boundary_force(p.world, p.world.rest, "barrier", {0, 1}).isZero());
    }
}

// The boundary of the lower plate runs along lines of the upper one, that of the upper plate along lines of the lower one, or both.
TEST_CASE("overlap boundary: round-off along lines of the meshes changes no force", "[contact][overlap_boundary]") {
  for (const auto& [shift, cells] : {std::pair(side / 6, std::array{6, 5}), std::pair(0.4 * side, std::array{6, 5}), std::pair(0.4 * side, std::array{1, 10}),
                                     std::pair(side / 2, std::array{4, 4})})
    for (const double off : {0.0, 1e-16, -1e-16, 1e-12, -1e-12, 3e-10, -3e-10, 1e-9, -1e-9, 1e-7, -1e-7})
      for (const double angle : {0.0, 1e-16, 1e-12, 1e-9}) {
        Places p(plates(shift + off * side, angle, cells));
        p.begin(p.world.rest);
        INFO("shift " << shift << " and " << off << " sides, turned by " << angle << ", cells " << cells[0] << " and " << cells[1]);
        const double width = side - 0.00073;
        CHECK(overlap_boundary_force(p.world, p.world.rest, "adhesion", {0, 1}).x() == Approx(-p.depth() * width).epsilon(1e-3));
      }
}

TEST_CASE("overlap boundary: areas change by no more than the swept area", "[contact][overlap_boundary]") {
  // Where lines of the meshes meet, and beside.
  for (const double shift : {side / 6, 0.4 * side, side / 2, 0.0071})
    for (const std::array<int, 2> cells : {std::array{6, 5}, std::array{2, 10}}) {
      Places p(plates(shift, 0, cells));
      VecX x = p.world.rest;
      const double before = p.energy(x);
      for (int v = 0; v < p.world.bodies[0].vertex_count; ++v) x(3 * v) += 1e-8;
      INFO("shift " << shift << ", cells " << cells[0] << " and " << cells[1]);
      CHECK(std::abs(p.energy(x) - before) < 3 * p.depth() * side * 1e-8);
    }
}

TEST_CASE("overlap boundary: a closed path does no work", "[contact][overlap_boundary]") {
  const auto path = [](const char* frames) {
    return std::string(", motion: [{type: keyframes, select: {type: face, direction: [0, 1, 0]}, frames: [") + frames + "]}]";
  };
  const std::string slid = path("{time: 0, translation: [0, 0, 0]}, {time: 0.2, translation: [0, -2.5e-3, 0]}, "
                               "{time: 0.5, translation: [0.01, -2.5e-3, 0]}, {time: 0.7, translation: [0.01, 0, 0]}");
  const std::string back = path("{time: 0, translation: [0, 0, 0]}, {time: 0.1, translation: [0.01, 0, 0]}, {time: 0.3, translation: "
                               "[0.01, -2.5e-3, 0]}, {time: 0.5, translation: [0, -2.5e-3, 0]}, {time: 0.7, translation: [0, 0, 0]}");
  for (const std::string& script : {slid, back}) {
    std::string scene = plates(0.00021, 0, {6, 5}, 3.22e-3, script, 1e-3);
    const std::string lower = "     energies: [{type: neo_hookean, young: 2e7, density: 10}]}\n";
    scene.replace(scene.find(lower), lower.size(), "     motion: [fixed]}\n");
    TestRun run("time: {step: 5 ms, duration: 0.7}\nsolver: {type: projected_newton, tolerance: 1e-4}\n" + scene);
    EnergyFlows sum;
    double pulled = 0;  // work of the overlap-boundary forces while the boundary crosses the face
    for (int i = 0; i < 140; ++i) {
      const EnergyFlows flows = run.step().flows;
      sum += flows;
      if (i >= 40 && i < 100) pulled += flows.of("work_rim");
    }
    const double work_of_full_overlap = side * side;  // of a work of adhesion of 1 J/m^2
    if (script == slid) {
      const auto& laws = run.world->contact->pairs().laws(LawTerm::all);
      const double depth = -laws[run.world->contact->pairs().point(0, 1).law].at(0.8e-3).value;
      CHECK(pulled == Approx(-depth * 0.01 * (side - 0.00073)).epsilon(0.03));
    }
    INFO(script);
    CHECK(std::abs(sum.prescribed_motion) < 0.02 * work_of_full_overlap);
    CHECK(std::abs(sum.areas) < 0.01 * work_of_full_overlap);
  }
}
