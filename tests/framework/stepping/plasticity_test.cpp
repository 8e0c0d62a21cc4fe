// Plastic solids in time steps: stored and rolled back history variables, and the convergence of
// Newton's method.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/world/energy_records.hpp"
#include "tests/support/published.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// A block of E = 1 MPa that yields at 2 kPa, its upper face pulled up by 2% per second.
std::string stretched(const std::string& integrator, double h, const std::string& solver, double hardening = 1e5) {
  return fmt::format(
      "time: {{step: {}, duration: 10, integrator: {}}}\nsolver: {{type: projected_newton, linear: cholmod, {}}}\n"
      "objects:\n"
      "  - name: block\n    shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}}\n"
      "    energies: [{{type: von_mises, young: 1e6, poisson: 0.3, yield_stress: 2e3, hardening: {}}}]\n"
      "    motion: [{{type: fixed, select: {{type: face, direction: [0, -1, 0]}}}},\n"
      "             {{type: translate, velocity: [0, 2e-3, 0], select: {{type: face, direction: [0, 1, 0]}}}}]\n",
      h, integrator, solver, hardening);
}

const std::string precise = "stopping: force, force_tolerance: 1e-12";

double largest_strain(const TestRun& run) {
  return Published(*run.world->elastic_terms[0]).field("plastic_strain").maxCoeff();
}

}  // namespace

TEST_CASE("Newton's method ends quadratically while a block yields", "[plasticity]") {
  for (const double hardening : {1e5, 0.0}) {
    INFO("H = " << hardening);
    TestRun run(stretched("quasi_static", 0.2, precise + ", projection: none", hardening));
    std::vector<double> residuals;
    run.stepper.observe({[&](int, double residual, double, double) { residuals.push_back(residual); }, {}, {}});
    for (int i = 0; i < 3; ++i) {
      residuals.clear();
      REQUIRE(run.step().rejections.cutbacks() == 0);
      // Quadratic convergence: an iteration doubles the number of correct digits, up to round-off.
      int doubled = 0;
      for (size_t k = 1; k + 1 < residuals.size(); ++k) {
        const double first = residuals.front();
        const double before = residuals[k] / first, after = residuals[k + 1] / first;
        if (before < 1e-2 && before > 1e-6) doubled += after < std::max(std::pow(before, 1.6), 1e-12);
      }
      CAPTURE(i, residuals);
      if (i > 0) CHECK(doubled >= 1);
      CHECK(residuals.size() <= 15);
    }
    CHECK(largest_strain(run) > 1e-3);
  }
}

TEST_CASE("a failed step that is cut back does not change the history", "[plasticity]") {
  TestRun run(stretched("implicit_euler", 0.2, "stopping: force, force_tolerance: 1e-10, max_iterations: 7"));
  run.step();
  run.step();
  const History before = run.state().history;
  REQUIRE(before.count("block/energies/0/plastic_inverse"));
  REQUIRE(largest_strain(run) > 0);
  bool failed = false;
  for (const double h : {0.4, 5.0, 200.0}) {
    const SolveResult result = run.stepper.solve(h);
    failed = failed || !run.stepper.validate(result).fault.empty();
    CHECK(run.state().history == before);
  }
  CHECK(failed);
  // Rejected solves do not change later steps.
  TestRun other(stretched("implicit_euler", 0.2, "stopping: force, force_tolerance: 1e-10, max_iterations: 7"));
  other.step();
  other.step();
  run.step();
  other.step();
  CHECK((run.state().x - other.state().x).lpNorm<Eigen::Infinity>() <= 1e-9);
  CHECK(largest_strain(run) == Approx(largest_strain(other)).epsilon(1e-6));
  CHECK_FALSE(run.state().history == before);
}

TEST_CASE("the work of a prescribed motion is stored, plastic work and numerical loss", "[plasticity]") {
  for (const std::string integrator : {"quasi_static", "implicit_euler", "bdf2", "newmark"}) {
    INFO(integrator);
    TestRun run(stretched(integrator, 0.02, "tolerance: 1e-8, force_tolerance: 1e-10"));
    EnergyFlows sum;
    StepReport last;
    for (int i = 0; i < 50; ++i) {
      sum += (last = run.step()).flows;
      CHECK(last.flows.of("dissipated_plastic") >= 0);
    }
    const double stored = stored_energy(last.energies);
    CHECK(sum.prescribed_motion == Approx(stored + sum.of("dissipated_plastic") + sum.numerics).epsilon(1e-9));
    CHECK(std::abs(sum.numerics) <= 0.01 * sum.prescribed_motion);
    CHECK(sum.of("dissipated_plastic") > 0.5 * sum.prescribed_motion);
    CHECK(run.state().energy.dissipated_as("dissipated_plastic") == Approx(sum.of("dissipated_plastic")).epsilon(1e-12));
  }
}

TEST_CASE("ten steps of plastic flow end where many steps do", "[plasticity]") {
  const auto end = [](int steps) {
    TestRun run(stretched("quasi_static", 1.0 / steps, precise));
    for (int i = 0; i < steps; ++i) run.step();
    return std::pair(run.state().energy.dissipated_as("dissipated_plastic"), run.state().x);
  };
  const auto [few, x_of_few] = end(10);
  const auto [many, x_of_many] = end(200);
  CHECK(few == Approx(many).epsilon(0.01));
  CHECK((x_of_few - x_of_many).norm() <= 0.01 * (x_of_many - TestRun(stretched("quasi_static", 1, precise)).world->rest).norm());
}

TEST_CASE("methods for sums of squares refuse a plastic solid by name", "[plasticity]") {
  CHECK_THROWS_WITH(TestRun("solver: {type: ceres_trust_region}\nobjects: [{name: box, shape: {type: box, size: [1, 1, 1]},\n"
                               "  energies: [{type: von_mises, young: 1e5, yield_stress: 1e3}]}]\n"),
                    Catch::Contains("'von_mises'"));
}
