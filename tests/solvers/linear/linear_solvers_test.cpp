// Every linear solver of double precision on random matrices.
#include <catch2/catch.hpp>

#include "framework/core/linear_solver.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/random_blocks.hpp"

using namespace tack;

namespace {

double residual(LinearSolver& solver, const BlockMatrix& matrix, RandomMotions& random) {
  PhaseClock clock;
  const VecX b = random.vectors(matrix.size());
  VecX x, product;
  REQUIRE(solver.factorize(matrix, clock));
  solver.solve(b, x, clock);
  matrix.multiply(x, product);
  return (product - b).norm() / b.norm();
}

bool direct(const std::string& type) { return type != "lagged_cholesky" && type != "pcg" && type != "auto"; }

// Iterations stop where the default tolerance is met, in the norm of the preconditioner.
double accuracy(const std::string& type) { return direct(type) ? 1e-12 : 0.05; }

template <class Check>
void for_each_solver(const Check& check) {
  for (const Variant& v : variants<LinearSolver>()) {
    INFO(v.yaml);
    if (v.yaml.find("single") == std::string::npos) check(v.type, *component<LinearSolver>(v.yaml));
  }
}

}  // namespace

TEST_CASE("linear solvers solve", "[linear]") {
  for_each_solver([](const std::string& type, LinearSolver& solver) {
    RandomMotions random(1);
    for (const int columns : {1, 2, 10, 150}) {
      const BlockMatrix matrix = random_spd(columns, random);
      CHECK(residual(solver, matrix, random) < accuracy(type));
    }
  });
}

TEST_CASE("linear solvers follow new values and new structures", "[linear]") {
  for_each_solver([](const std::string& type, LinearSolver& solver) {
    RandomMotions random(2);
    const double small = accuracy(type);
    BlockMatrix matrix = random_spd(60, random);
    CHECK(residual(solver, matrix, random) < small);
    const int analyses = solver.analyses();
    for (int i = 0; i < 5; ++i) {  // the same structure
      const BlockMatrix other = random_spd(60, random);
      for (int c = 0; c < 60; ++c)
        matrix.block(matrix.column_start[c]) += other.block(other.column_start[c]).diagonal().asDiagonal();
      CHECK(residual(solver, matrix, random) < small);
    }
    CHECK(solver.analyses() == analyses);
    for (const int neighbours : {5, 2, 8}) {
      CHECK(residual(solver, random_spd(60, random, neighbours), random) < small);
      CHECK(residual(solver, random_spd(60 + neighbours, random, neighbours), random) < small);
    }
    if (direct(type)) CHECK(solver.analyses() == analyses + 6);
  });
}

TEST_CASE("linear solvers refuse matrices that are not positive definite", "[linear]") {
  for_each_solver([](const std::string&, LinearSolver& solver) {
    RandomMotions random(3);
    PhaseClock clock;
    BlockMatrix matrix = random_spd(30, random);
    const BlockMatrix good = matrix;
    matrix.block(matrix.column_start[17])(1, 1) = -5;
    CHECK_FALSE(solver.factorize(matrix, clock));
    CHECK(residual(solver, good, random) < accuracy("lagged_cholesky"));  // and recover
  });
}

TEST_CASE("cholmod solves with simplicial factors too", "[linear]") {
  const auto solver = component<LinearSolver>("{type: cholmod, supernodal: false}");
  RandomMotions random(5);
  PhaseClock clock;
  for (const int columns : {1, 150, 60}) CHECK(residual(*solver, random_spd(columns, random), random) < 1e-12);
  BlockMatrix indefinite = random_spd(30, random);
  indefinite.block(indefinite.column_start[17])(1, 1) = -5;
  CHECK_FALSE(solver->factorize(indefinite, clock));
}

// A matrix may turn indefinite while the factor of an earlier one is still in use.
TEST_CASE("a lagged factor does not hide an indefinite matrix", "[linear]") {
  const auto solver = component<LinearSolver>("lagged_cholesky");
  RandomMotions random(4);
  PhaseClock clock;
  BlockMatrix matrix = random_spd(30, random);
  CHECK(residual(*solver, matrix, random) < accuracy("lagged_cholesky"));
  for (int c = 0; c < 30; ++c) matrix.block(matrix.column_start[c]) *= -1;
  VecX x;
  const bool factorized = solver->factorize(matrix, clock);
  if (factorized) solver->solve(random.vectors(90), x, clock);
  CHECK((!factorized || !x.allFinite()));
}
