// Every linear solver of double precision on random matrices.
#include <catch2/catch.hpp>

#include "framework/core/linear_solver.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/random_blocks.hpp"

using namespace tack;

namespace {

double residual(const BlockMatrix& matrix, const VecX& x, const VecX& b) {
  VecX product;
  matrix.multiply(x, product);
  return (product - b).norm() / b.norm();
}

double residual(LinearSolver& solver, const BlockMatrix& matrix, RandomMotions& random) {
  PhaseClock clock;
  const VecX b = random.vectors(matrix.size());
  VecX x;
  REQUIRE(solver.factorize(matrix, clock));
  solver.solve(b, x, clock);
  return residual(matrix, x, b);
}

bool direct(const std::string& type) { return type != "lagged_cholesky" && type != "pcg" && type != "auto"; }

// Iterative solvers stop at the tolerance, in the norm of their preconditioner.
constexpr double told = 1e-10;
double accuracy(const std::string& type) { return direct(type) ? 1e-12 : 10 * told; }

template <class Check>
void for_each_solver(const Check& check) {
  for (const ComponentVariant& v : variants<LinearSolver>()) {
    INFO(v.yaml);
    if (v.yaml.find("single") != std::string::npos) continue;
    const auto solver = component<LinearSolver>(v.yaml);
    solver->set_tolerance(told);
    check(v.type, *solver);
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

TEST_CASE("own linear solvers stop at the time limit and clear their data", "[linear]") {
  for_each_solver([](const std::string& type, LinearSolver& solver) {
    if (type == "cholmod" || type == "eigen_ldlt") return;
    RandomMotions random(3);
    const BlockMatrix matrix = random_spd(60, random), other = random_spd(70, random);
    CHECK(residual(solver, matrix, random) < accuracy(type));
    PhaseClock clock;
    clock.deadline().limit_run(Deadline::Clock::now(), 0);
    VecX x;
    CHECK_THROWS_AS([&] {
      if (solver.factorize(other, clock)) solver.solve(random.vectors(other.size()), x, clock);
    }(), OutOfTime);
    CHECK(residual(solver, matrix, random) < accuracy(type));
  });
}

TEST_CASE("linear solvers follow new values and new structures", "[linear]") {
  for_each_solver([](const std::string& type, LinearSolver& solver) {
    RandomMotions random(2);
    const double small = accuracy(type);
    BlockMatrix matrix = random_spd(60, random);
    CHECK(residual(solver, matrix, random) < small);
    const int analyses = solver.analyses();
    for (int i = 0; i < 5; ++i) {  // equal structure
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
  for_each_solver([](const std::string& type, LinearSolver& solver) {
    RandomMotions random(3);
    PhaseClock clock;
    BlockMatrix matrix = random_spd(30, random);
    const BlockMatrix good = matrix;
    matrix.block(matrix.column_start[17])(1, 1) = -5;
    CHECK_FALSE(solver.factorize(matrix, clock));
    CHECK(residual(solver, good, random) < accuracy(type));  // and recover
  });
}

// By default, a lagged factor leaves 3% and conjugate gradients 0.1% of the preconditioner's norm.
TEST_CASE("an inexact iterative solution is corrected to the requested residual", "[linear]") {
  for (const ComponentVariant& v : variants<LinearSolver>()) {
    INFO(v.yaml);
    const auto solver = component<LinearSolver>(v.yaml);
    RandomMotions random(6);
    PhaseClock clock;
    BlockMatrix matrix = random_spd(60, random);
    VecX x, correction, product;
    solver->factorize(matrix, clock);
    solver->solve(random.vectors(matrix.size()), x, clock);
    for (int c = 0; c < 60; ++c) matrix.block(matrix.column_start[c]).diagonal() *= 1.3;  // the lagged factor is outdated now
    const VecX b = random.vectors(matrix.size());
    REQUIRE(solver->factorize(matrix, clock));
    solver->solve(b, x, clock);
    const double before = residual(matrix, x, b);
    for (const double relative : {0.3, 1e-3, 1e-9}) {
      matrix.multiply(x, product);
      const VecX left = b - product;
      if (left.norm() < 1e-13 * b.norm()) break;
      solver->correct(left, correction, relative, clock);
      const double worst = v.yaml.find("single") == std::string::npos ? 10 * relative : 1e-4;
      CHECK(residual(matrix, correction, left) < std::max(worst, 1e-12));
      x += correction;
    }
    CHECK(residual(matrix, x, b) < 1e-9);
    CHECK(residual(matrix, x, b) <= before);
    // The next solution has the solver's own tolerance again, not that of the correction.
    VecX again;
    solver->solve(b, again, clock);
    CHECK(residual(matrix, again, b) < 0.05);
  }
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
  solver->set_tolerance(told);
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

TEST_CASE("the cost of another matrix can be predicted while a factor is stored", "[linear]") {
  for_each_solver([](const std::string& type, LinearSolver& solver) {
    RandomMotions random(6);
    const BlockMatrix matrix = random_spd(60, random, 8), fuller = random_spd(60, random, 3);
    CHECK(residual(solver, matrix, random) < accuracy(type));
    PhaseClock clock;
    const VecX b = random.vectors(matrix.size());
    VecX x, again;
    REQUIRE(solver.factorize(matrix, clock));
    solver.solve(b, x, clock);
    solver.predict(fuller, clock);
    solver.solve(b, again, clock);
    CHECK(residual(matrix, again, b) < accuracy(type));
    CHECK(residual(solver, fuller, random) < accuracy(type));
  });
}
