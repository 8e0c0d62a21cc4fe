// Inexact Newton against Newton with factors.
#include <catch2/catch.hpp>

#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// A soft box falls askew on a floor, with friction.
std::string drop(const std::string& solver) {
  return "time: {step: 10 ms, duration: 1 s}\n"
         "gravity: [0, -9.81, 0]\n"
         "objects:\n"
         "  - {name: floor, shape: {type: box, size: [1, 0.1, 1]}, place: {translate: [0, -0.05, 0]},\n"
         "     motion: [fixed]}\n"
         "  - {name: box, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}, velocity: [0.3, -0.5, 0],\n"
         "     place: {axis: [1, 0.3, 2], angle: 0.2, translate: [0, 0.07, 0]},\n"
         "     energies: [{type: neo_hookean, young: 1e5, poisson: 0.4}]}\n"
         "contact: {distance: 1 mm, friction: {mu: 0.3}}\n"
         "solver: " + solver + "\n";
}

struct Dropped {
  VecX x;
  MinimizerResult work;
  int contacts = 0;
};
Dropped dropped(const std::string& solver) {
  TestRun simulation(drop(solver));
  Dropped d;
  for (int s = 0; s < 12; ++s) {
    const StepReport report = simulation.step();
    CHECK(report.converged);
    d.work.add_work(report.solve);
    d.contacts = std::max(d.contacts, report.contacts);
  }
  d.x = simulation.state().x;
  return d;
}

}  // namespace

TEST_CASE("inexact Newton finds the same minima as Newton's method", "[minimizers]") {
  const Dropped exact = dropped("{type: projected_newton, tolerance: 1e-6, linear: cholmod}");
  REQUIRE(exact.contacts > 0);
  for (const char* linear : {"pcg", "{type: pcg, preconditioner: block_jacobi}", "lagged_cholesky"}) {
    INFO(linear);
    const Dropped inexact =
        dropped(std::string("{type: newton_pcg, tolerance: 1e-6, linear: ") + linear + "}");
    CHECK((inexact.x - exact.x).lpNorm<Eigen::Infinity>() < 1e-7);
    CHECK(inexact.work.iterations < 2 * exact.work.iterations);
  }
}

// However loosely systems are solved, the direction that stops a solve is corrected until it may be believed.
TEST_CASE("inexact Newton does not mistake a badly solved step for a small one", "[minimizers]") {
  const Dropped exact = dropped("{type: projected_newton, tolerance: 1e-5, linear: cholmod}");
  const Dropped loose = dropped("{type: newton_pcg, tolerance: 1e-5, forcing_max: 0.5, forcing_min: 0.1}");
  CHECK((loose.x - exact.x).lpNorm<Eigen::Infinity>() < 1e-6);
  CHECK(loose.work.linear_solves > loose.work.iterations);
  CHECK_THROWS(TestRun(drop("{type: newton_pcg, forcing_max: 1e-5, forcing_min: 1e-4}")));
}
