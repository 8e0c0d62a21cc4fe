// The trust-region method on functions with indefinite Hessians and known minima.
#include <catch2/catch.hpp>

#include "framework/core/minimizer.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/formula_objective.hpp"

using namespace tack;

namespace {

struct Ended {
  MinimizerResult result;
  VecX q;
  int values;
};

Ended minimize(const FormulaObjective::Formula& formula, const VecX& start, const std::string& settings = "") {
  FormulaObjective objective(formula, start);
  PhaseClock clock;
  VecX q = start;
  const MinimizerProblem problem{objective, [](const VecX&, const VecX&) { return 1.0; },
                                 [](const VecX& p, const VecX&) { return p.lpNorm<Eigen::Infinity>() / 1e-9; }, clock};
  const MinimizerResult result = component<Minimizer>("{type: trust_region_newton" + settings + "}")->minimize(problem, q);
  return {result, q, objective.value_count()};
}

// Rosenbrock's valley in three unknowns, sum of 100 (x_{i+1} - x_i^2)^2 + (1 - x_i)^2: minimum at (1, 1, 1).
const FormulaObjective::Formula rosenbrock = {
    [](const VecX& x) {
      double sum = 0;
      for (int i = 0; i < 2; ++i) sum += 100 * std::pow(x(i + 1) - x(i) * x(i), 2) + std::pow(1 - x(i), 2);
      return sum;
    },
    [](const VecX& x) {
      VecX g = VecX::Zero(3);
      for (int i = 0; i < 2; ++i) {
        const double d = x(i + 1) - x(i) * x(i);
        g(i) += -400 * d * x(i) - 2 * (1 - x(i));
        g(i + 1) += 200 * d;
      }
      return g;
    },
    [](const VecX& x) {
      Eigen::MatrixXd h = Eigen::MatrixXd::Zero(3, 3);
      for (int i = 0; i < 2; ++i) {
        h(i, i) += -400 * (x(i + 1) - 3 * x(i) * x(i)) + 2;
        h(i + 1, i + 1) += 200;
        h(i, i + 1) -= 400 * x(i);
        h(i + 1, i) -= 400 * x(i);
      }
      return h;
    }};

// Two wells of each unknown, minima at -1 and 1, a maximum at 0.
const FormulaObjective::Formula wells = {
    [](const VecX& x) { return (x.array().square() * (x.array().square() / 4 - 0.5)).sum(); },
    [](const VecX& x) { return VecX(x.array() * (x.array().square() - 1)); },
    [](const VecX& x) { return Eigen::MatrixXd(VecX(3 * x.array().square() - 1).asDiagonal()); }};

}  // namespace

TEST_CASE("trust region: the bottom of Rosenbrock's valley", "[minimizer]") {
  const Ended e = minimize(rosenbrock, Vec3(-1.2, 1, 1), ", step: [straight]");
  CHECK(e.result.status == MinimizerStatus::converged);
  CHECK((e.q - Vec3(1, 1, 1)).norm() < 1e-7);
  CHECK(e.result.iterations < 60);
}

TEST_CASE("trust region: negative curvature leads away from a maximum", "[minimizer]") {
  for (const double start : {1e-7, 1e-3, 0.3, 0.5}) {
    INFO(start);
    const Ended e = minimize(wells, Vec3(start, -start, 2 * start));
    CHECK(e.result.status == MinimizerStatus::converged);
    CHECK((e.q - Vec3(1, -1, 1)).norm() < 1e-7);
    CHECK(e.result.iterations < 60);
  }
}

TEST_CASE("trust region: a convex quadratic takes a Newton step and one that confirms it", "[minimizer]") {
  const VecX minimum = VecX::LinSpaced(9, -1, 1);
  FormulaObjective objective = chain(3, minimum);
  PhaseClock clock;
  VecX q = VecX::Zero(9);
  const MinimizerProblem problem{objective, [](const VecX&, const VecX&) { return 1.0; },
                                 [](const VecX& p, const VecX&) { return p.lpNorm<Eigen::Infinity>() / 1e-9; }, clock};
  const MinimizerResult result = component<Minimizer>("{type: trust_region_newton, forcing_min: 1e-12, forcing_max: 1e-6}")->minimize(problem, q);
  CHECK(result.status == MinimizerStatus::converged);
  CHECK((q - minimum).norm() < 1e-8);
  CHECK(result.iterations <= 3);
}
