// Anderson acceleration of linear problems, where it has a closed form: with a window of all steps
// it is GMRES, which ends after as many steps as the map has eigenvalues.
#include <catch2/catch.hpp>

#include "framework/core/minimizer.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/formula_objective.hpp"

using namespace tack;

namespace {

ChainEnd minimize(int particles, const std::string& settings, double feasible = 1) {
  return minimize_chain(particles, "{type: anderson, metric: block_diagonal, max_iterations: 10000" + settings + "}", 1e-7, feasible);
}

}  // namespace

TEST_CASE("Anderson: a linear problem ends after as many steps as it has eigenvalues", "[minimizer]") {
  for (const int particles : {3, 5, 8}) {
    INFO(particles);
    const ChainEnd e = minimize(particles, ", window: 10");
    CHECK(e.result.status == MinimizerStatus::converged);
    CHECK(e.error.norm() < 1e-6);
    CHECK(e.result.iterations <= particles + 1);
  }
}

TEST_CASE("Anderson: without a window it is the plain fixed point", "[minimizer]") {
  // Jacobi's method on 8 particles: the error falls by cos(pi / 9) in a step.
  const ChainEnd plain = minimize(8, ", window: 0"), short_window = minimize(8, ", window: 2");
  CHECK(plain.result.status == MinimizerStatus::converged);
  CHECK(plain.result.iterations > 150);
  CHECK(short_window.result.status == MinimizerStatus::converged);
  CHECK(2 * short_window.result.iterations < plain.result.iterations);
}

TEST_CASE("Anderson: truncated steps still lead to the minimum", "[minimizer]") {
  const ChainEnd e = minimize(5, "", 0.3);
  CHECK(e.result.status == MinimizerStatus::converged);
  CHECK(e.error.norm() < 1e-6);
}
