// The solver that `auto` chooses, and when it changes its choice.
#include <catch2/catch.hpp>

#include "framework/core/linear_solver.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/random_blocks.hpp"

using namespace tack;

namespace {

bool starts_with(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

// Conjugate gradients stop at 1% in the norm of their preconditioner, which a stiff matrix weighs differently;
// a factor that was made for the matrix is one of single precision.
constexpr double accuracy = 0.1;

// Groups of columns, all of one group coupled: little fill for many blocks.
BlockMatrix cliques(int groups, int size) {
  BlockMatrix matrix;
  matrix.version = 1u << 30;
  matrix.column_start.push_back(0);
  for (int c = 0; c < groups * size; ++c) {
    for (int r = c; r < (c / size + 1) * size; ++r) {
      matrix.row.push_back(r);
      const Mat3 block = (r == c ? 1.0 * size : -0.9) * Mat3::Identity();
      matrix.values.insert(matrix.values.end(), block.data(), block.data() + 9);
    }
    matrix.column_start.push_back(static_cast<int>(matrix.row.size()));
  }
  return matrix;
}

// Returns its description after some systems of the matrix.
std::string chosen(LinearSolver& solver, const BlockMatrix& matrix, RandomMotions& random, int systems = 1) {
  PhaseClock clock;
  for (int i = 0; i < systems; ++i) {
    const VecX b = random.vectors(matrix.size());
    VecX x, product;
    REQUIRE(solver.factorize(matrix, clock));
    solver.solve(b, x, clock);
    matrix.multiply(x, product);
    CHECK((product - b).norm() < accuracy * b.norm());
  }
  return solver.describe();
}

}  // namespace

TEST_CASE("pins the sizes at which auto changes: small systems are factorised, large solids iterated on", "[linear]") {
  RandomMotions random(1);
  const auto solver = component<LinearSolver>("auto");
  CHECK(starts_with(chosen(*solver, random_spd(60, random, 8), random), "lagged_cholesky (180 unknowns"));
  CHECK(starts_with(chosen(*solver, grid(14, random), random, 6), "pcg (8232 unknowns"));
  CHECK(starts_with(chosen(*solver, random_spd(70, random, 8), random), "lagged_cholesky (210 unknowns"));
}

TEST_CASE("auto analyses the factor only where its bounds do not decide", "[linear]") {
  RandomMotions random(5);
  const BlockMatrix solid = grid(14, random);
  const auto solver = component<LinearSolver>("auto");
  CHECK(chosen(*solver, solid, random, 6).find("at least") != std::string::npos);
  CHECK(solver->analyses() == 0);
  // Iterations above the lower bound of the budget call for the analysis, not for the factor.
  const auto slow = component<LinearSolver>("{type: auto, iterative: {type: pcg, preconditioner: block_jacobi, tolerance: 1e-9}}");
  CHECK(starts_with(chosen(*slow, grid(14, random, 30), random, 4), "pcg"));
  CHECK(slow->analyses() == 1);
}

TEST_CASE("the minimum-degree bound lies between the cost of the best ordering and a few times that", "[linear]") {
  RandomMotions random(6);
  PhaseClock clock;
  for (const int cells : {4, 9, 20}) {
    const BlockMatrix solid = grid(cells, random);
    const auto solver = component<LinearSolver>("multifrontal");
    const FactorCost bound = solver->bound(solid, clock).value(), best = solver->predict(solid, clock).value();
    CHECK(bound.operations >= best.operations);
    CHECK(bound.operations <= 4 * best.operations);
    CHECK(bound.entries <= 2 * best.entries);
    const auto metis = component<LinearSolver>("{type: multifrontal, ordering: metis}");
    CHECK(metis->bound(solid, clock)->operations == metis->predict(solid, clock)->operations);
  }
}

TEST_CASE("auto switches from iterations that fail or are too many", "[linear]") {
  RandomMotions random(2);
  const BlockMatrix mild = grid(14, random), stiff = grid(14, random, 1e6);
  const auto patient = component<LinearSolver>("{type: auto, iterative: {type: pcg, preconditioner: block_jacobi}}");
  CHECK(starts_with(chosen(*patient, mild, random), "pcg"));
  CHECK(starts_with(chosen(*patient, stiff, random, 4), "lagged_cholesky (in place of pcg: it took "));
  const VecX b = random.vectors(stiff.size());
  VecX x, product;
  PhaseClock clock;
  patient->correct(b, x, 1e-9, clock);
  stiff.multiply(x, product);
  CHECK((product - b).norm() < 1e-3 * b.norm());
  const auto strict = component<LinearSolver>("{type: auto, iterative: {type: pcg, max_iterations: 1}}");
  CHECK(starts_with(chosen(*strict, stiff, random), "lagged_cholesky (in place of pcg: it did not converge"));
}

TEST_CASE("pins the fill at which auto changes: couplings that fill the factor are iterated on", "[linear]") {
  RandomMotions random(4);
  const auto solver = component<LinearSolver>("auto");
  CHECK(starts_with(chosen(*solver, cliques(70, 40), random), "lagged_cholesky (8400 unknowns"));
  CHECK(starts_with(chosen(*solver, random_spd(2800, random, 8), random, 3), "pcg (8400 unknowns"));
}

TEST_CASE("auto refuses indefinite matrices with any choice", "[linear]") {
  RandomMotions random(3);
  BlockMatrix matrix = grid(14, random);
  const auto solver = component<LinearSolver>("auto");
  chosen(*solver, matrix, random);
  matrix.block(matrix.column_start[900])(1, 1) = -5;
  PhaseClock clock;
  CHECK_FALSE(solver->factorize(matrix, clock));
}

TEST_CASE("auto does not count expected indefinite systems as failures of conjugate gradients", "[linear]") {
  RandomMotions random(4);
  const BlockMatrix matrix = grid(14, random);
  BlockMatrix indefinite = matrix;
  for (int c = 0; c < matrix.columns(); ++c) indefinite.block(matrix.column_start[c]).diagonal().array() -= 3;
  const bool expected = GENERATE(true, false);
  const auto solver = component<LinearSolver>("auto");
  REQUIRE(starts_with(chosen(*solver, matrix, random), "pcg"));
  PhaseClock clock;
  VecX x;
  solver->expect_indefinite(expected);
  const bool factorised = solver->factorize(indefinite, clock);
  if (factorised) solver->solve(random.vectors(matrix.size()), x, clock);
  CHECK((!factorised || !x.allFinite()));
  solver->expect_indefinite(false);
  CHECK(starts_with(chosen(*solver, matrix, random), expected ? "pcg" : "lagged_cholesky"));
}
