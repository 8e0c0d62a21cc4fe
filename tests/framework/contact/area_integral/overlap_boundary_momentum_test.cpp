// Two free bodies that adhere along part of their faces turn each other.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

constexpr double side = 0.02, gap = 0.8e-3;  // m

std::string scene(const std::string& integrator, double h) {
  return fmt::format(
      "time: {{step: {1}, duration: 1, integrator: {2}}}\nsolver: {{type: projected_newton, tolerance: 1e-9}}\n"
      "objects:\n"
      "  - {{name: upper, shape: {{type: box, size: [{0}, 0.005, {0}], cells: [6, 1, 6]}},\n"
      "     place: {{axis: [0, 1, 0], angle: 0.4, translate: [0.0072, {3}, 0.00013]}}, energies: [{{type: neo_hookean, young: 2e7, density: 1000}}]}}\n"
      "  - {{name: lower, shape: {{type: box, size: [{0}, 0.005, {0}], cells: [5, 1, 5]}}, place: {{translate: [0, -0.0025, 0]}},\n"
      "     energies: [{{type: neo_hookean, young: 2e7, density: 1000}}]}}\n"
      "contact:\n  distance: 0.05 mm\n"
      "  pairs: [{{between: [upper, lower], adhesion: {{type: fang, peak_traction: 100, peak_distance: 1 mm, range: 2 mm}}}}]\n",
      side, h, integrator, 0.0025 + gap);
}

std::array<Vec3, 2> angular_momenta(const World& world, const State& state) {
  std::array<Vec3, 2> sum = {Vec3::Zero(), Vec3::Zero()};
  for (int v = 0; v < state.x.size() / 3; ++v)
    sum[world.body_of(v)] += world.mass[v] * Vec3(vertex(state.x, v)).cross(Vec3(vertex(state.v, v)));
  return sum;
}

}  // namespace

// The forces have no moment where they are taken (rim_forces_test); held through a step they have one by what the bodies move along each other
// meanwhile, as integrators have their own.
TEST_CASE("overlap boundary: the common rotation of two free bodies shrinks with the step", "[contact][overlap_boundary]") {
  for (const std::string integrator : {"implicit_euler", "bdf2", "newmark"}) {
    const auto drift = [&](double h) {
      TestRun run(scene(integrator, h));
      for (int i = 0; i < std::lround(0.02 / h); ++i) run.step();
      const auto [a, b] = angular_momenta(*run.world, run.state());
      return (a + b).norm() / a.norm();
    };
    INFO(integrator);
    const double coarse = drift(1e-3), fine = drift(0.5e-3);
    CHECK(coarse < 0.06);
    if (integrator != "newmark") CHECK(fine < 0.55 * coarse);
    else CHECK(fine < 2e-3);  // it takes smaller steps by itself
  }
}
