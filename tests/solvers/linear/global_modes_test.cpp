// Matrices with parts of low rank that are in no block: every linear solver takes them.
#include <catch2/catch.hpp>

#include "framework/core/linear_solver.hpp"
#include "framework/core/mode_update.hpp"
#include "framework/core/symmetric_product.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/random_blocks.hpp"

using namespace tack;

namespace {

MatX whole(const BlockMatrix& matrix) {
  MatX sum = dense(matrix);
  for (const GlobalMode& mode : matrix.modes) sum += mode.coefficient * mode.vector * mode.vector.transpose();
  return sum;
}

BlockMatrix with_modes(int columns, const std::vector<double>& coefficients, RandomMotions& random) {
  BlockMatrix matrix = random_spd(columns, random);
  for (const double c : coefficients) matrix.modes.push_back({c, random.vectors(matrix.size())});
  return matrix;
}

}  // namespace

TEST_CASE("products have global modes", "[linear]") {
  RandomMotions random(1);
  const BlockMatrix matrix = with_modes(40, {3, -0.2}, random);
  const VecX x = random.vectors(matrix.size()), exact = whole(matrix) * x;
  VecX y;
  matrix.multiply(x, y);
  CHECK((y - exact).norm() < 1e-12 * exact.norm());
  SymmetricProduct().multiply(matrix, x, y);
  CHECK((y - exact).norm() < 1e-12 * exact.norm());
}

TEST_CASE("linear solvers solve with global modes of any size, and with changed modes", "[linear]") {
  for (const ComponentVariant& v : variants<LinearSolver>()) {
    if (v.yaml.find("single") != std::string::npos) continue;
    INFO(v.yaml);
    const auto solver = component<LinearSolver>(v.yaml);
    solver->set_tolerance(1e-11);
    RandomMotions random(2);
    PhaseClock clock;
    BlockMatrix matrix = with_modes(60, {}, random);
    for (const double size : {0.0, 1e-3, 1.0, 1e3, 1e6}) {
      matrix.modes = {{size, random.vectors(matrix.size())}, {0.3 * size, random.vectors(matrix.size())}};
      const VecX b = random.vectors(matrix.size());
      VecX x;
      REQUIRE(solver->factorize(matrix, clock));
      solver->solve(b, x, clock);
      const VecX exact = whole(matrix).ldlt().solve(b);
      CHECK((x - exact).norm() < 1e-8 * exact.norm());
      MatX columns = b;
      solver->solve_columns(columns, clock);
      CHECK((columns.col(0) - exact).norm() < 1e-8 * exact.norm());
    }
  }
}

TEST_CASE("a global mode hardly changes the number of iterations", "[linear]") {
  RandomMotions random(3);
  PhaseClock clock;
  const auto solver = component<LinearSolver>("{type: pcg, tolerance: 1e-8}");
  BlockMatrix matrix = grid(6, random);
  const VecX b = random.vectors(matrix.size());
  VecX x;
  REQUIRE(solver->factorize(matrix, clock));
  solver->solve(b, x, clock);
  const int without = solver->iterations();
  matrix.modes = {{1e9, random.vectors(matrix.size())}};
  REQUIRE(solver->factorize(matrix, clock));
  solver->solve(b, x, clock);
  CHECK(solver->iterations() <= without + 3);
}

// A mode below zero may leave the matrix positive definite, or not.
TEST_CASE("direct solvers detect whether a negative mode leaves a matrix positive definite", "[linear]") {
  for (const char* type : {"cholmod", "eigen_ldlt", "multifrontal"}) {
    INFO(type);
    const auto solver = component<LinearSolver>(type);
    RandomMotions random(4);
    PhaseClock clock;
    BlockMatrix matrix = with_modes(30, {}, random);
    const VecX u = random.vectors(matrix.size());
    const double least = 1 / u.dot(dense(matrix).ldlt().solve(u));  // A - c u u^T is singular there
    for (const double part : {0.5, 0.99, 1.01, 5.0}) {
      matrix.modes = {{2.0, random.vectors(matrix.size())}, {-part * least, u}};
      matrix.modes[0].vector -= matrix.modes[0].vector.dot(dense(matrix).ldlt().solve(u)) * least * u;  // conjugate to it
      CHECK(solver->factorize(matrix, clock) == (part < 1));
      CHECK((smallest_eigenvalue(whole(matrix)) > 0) == (part < 1));
    }
  }
}
