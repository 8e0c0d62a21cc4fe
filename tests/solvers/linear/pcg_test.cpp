// Conjugate gradients with every registered preconditioner.
#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "framework/core/linear_solver.hpp"
#include "solvers/linear/domain_rows.hpp"
#include "solvers/linear/preconditioner.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/linear_solve.hpp"
#include "tests/support/random_blocks.hpp"

using namespace tack;

namespace {

std::vector<std::string> preconditioners() { return Registry<Preconditioner>::kind().names(); }

std::string pcg(const std::string& preconditioner, const std::string& settings) {
  return "{type: pcg, preconditioner: " + preconditioner + ", " + settings + "}";
}

double relative_residual(const BlockMatrix& matrix, const VecX& x, const VecX& b) {
  VecX product;
  matrix.multiply(x, product);
  return (product - b).norm() / b.norm();
}

// Blocks a(i, j) times the identity.
BlockMatrix scalar_blocks(const MatX& a, std::uint64_t version) {
  BlockMatrix matrix;
  matrix.version = version;
  matrix.column_start.push_back(0);
  for (int c = 0; c < a.cols(); ++c) {
    for (int r = c; r < a.rows(); ++r) {
      if (a(r, c) == 0) continue;
      matrix.row.push_back(r);
      const Mat3 block = a(r, c) * Mat3::Identity();
      matrix.values.insert(matrix.values.end(), block.data(), block.data() + 9);
    }
    matrix.column_start.push_back(static_cast<int>(matrix.row.size()));
  }
  return matrix;
}

}  // namespace

TEST_CASE("conjugate gradients solve to the tolerance they are given", "[linear]") {
  RandomMotions random(1);
  const BlockMatrix matrix = grid(9, random, 1e3);
  const VecX b = random.vectors(matrix.size());
  for (const std::string& name : preconditioners()) {
    INFO(name);
    const Solved loose = solve(pcg(name, "tolerance: 0.1"), matrix, b);
    const Solved tight = solve(pcg(name, "tolerance: 1e-11"), matrix, b);
    CHECK(loose.iterations < tight.iterations);
    CHECK(relative_residual(matrix, tight.x, b) < 1e-8);
    const auto solver = component<LinearSolver>(pcg(name, "tolerance: 0.1"));
    PhaseClock clock;
    solver->set_tolerance(1e-11);
    REQUIRE(solver->factorize(matrix, clock));
    VecX x;
    solver->solve(b, x, clock);
    CHECK((x == tight.x));
    solver->solve(VecX::Zero(b.size()), x, clock);
    CHECK(x.norm() == 0);
  }
}

TEST_CASE("conjugate gradients have the same bits for 1, 2 and 4 threads", "[linear]") {
  RandomMotions random(2);
  const BlockMatrix matrix = grid(14, random, 100);
  const VecX b = random.vectors(matrix.size());
  for (const char* preconditioner : {"block_jacobi", "incomplete_cholesky", "{type: diagonal_cholesky, domain: 300}"}) {
    const auto with_threads = [&](size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return solve(pcg(preconditioner, "tolerance: 1e-6"), matrix, b).x;
    };
    CHECK((with_threads(1) == with_threads(2)));
    CHECK((with_threads(1) == with_threads(4)));
  }
}

TEST_CASE("failed conjugate gradients do not count as a solution", "[linear]") {
  RandomMotions random(3);
  const BlockMatrix matrix = grid(6, random);
  MatX saddle(2, 2);  // blocks on the diagonal that are definite hide an indefinite matrix
  saddle << 1, 3, 3, 1;
  const BlockMatrix indefinite = scalar_blocks(saddle, 1u << 30);
  VecX opposed(6);
  opposed << 1, 2, 3, -1, -2, -3;
  for (const std::string& name : preconditioners()) {
    INFO(name);
    const VecX b = random.vectors(matrix.size());
    CHECK_FALSE(solve(pcg(name, "tolerance: 1e-10, max_iterations: 2"), matrix, b).x.allFinite());
    const VecX cut = solve(pcg(name, "tolerance: 1e-10, max_iterations: 2, truncate: true"), matrix, b).x;
    CHECK(relative_residual(matrix, cut, b) < 1);
    // The incomplete factor of this one is complete but for its shift, and detects it.
    const auto solver = component<LinearSolver>(pcg(name, "truncate: true"));
    PhaseClock clock;
    VecX x;
    if (!solver->factorize(indefinite, clock)) continue;
    solver->solve(opposed, x, clock);
    CHECK_FALSE(x.allFinite());
  }
}

// Kershaw's matrix is positive definite, but its incomplete factor has a negative pivot.
TEST_CASE("an incomplete factor that breaks down is computed with a shift", "[linear]") {
  MatX kershaw(4, 4);
  kershaw << 3, -2, 0, 2, -2, 3, -2, 0, 0, -2, 3, -2, 2, 0, -2, 3;
  const BlockMatrix matrix = scalar_blocks(kershaw, (1u << 30) + 1);
  VecX b(12);
  for (int i = 0; i < 12; ++i) b(i) = std::sin(1.0 + i);
  const Solved solved = solve(pcg("incomplete_cholesky", "tolerance: 1e-12, max_iterations: 12"), matrix, b);
  CHECK(relative_residual(matrix, solved.x, b) < 1e-10);
  CHECK(solved.iterations > 1);
}

TEST_CASE("an incomplete factor without fill-in is complete", "[linear]") {
  const int n = 50;
  MatX chain = MatX::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    chain(i, i) = 2.001;
    if (i > 0) chain(i, i - 1) = chain(i - 1, i) = -1;
  }
  const BlockMatrix matrix = scalar_blocks(chain, (1u << 30) + 2);
  RandomMotions random(4);
  const VecX b = random.vectors(matrix.size());
  const auto iterations = [&](const std::string& preconditioner) {
    const Solved solved = solve(pcg(preconditioner, "tolerance: 1e-8"), matrix, b);
    CHECK(relative_residual(matrix, solved.x, b) < 1e-5);
    return solved.iterations;
  };
  CHECK(iterations("incomplete_cholesky") <= 3);
  CHECK(iterations("block_jacobi") >= 25);
}

TEST_CASE("domains are coupled through their separators only, and groups of domains are not coupled", "[linear]") {
  RandomMotions random(5);
  const BlockMatrix matrix = grid(20, random);
  DomainRows rows;
  rows.build(matrix, 100);
  CHECK(rows.domains() == 4);
  CHECK(rows.groups() >= 3);
  CHECK(rows.size() == matrix.columns());
  CHECK(rows.group_start.front() == rows.domain_start.back());
  CHECK(rows.group_start.back() == rows.size());
  CHECK(6 * (rows.size() - rows.group_start.front()) <= rows.size());
  for (int d = 0; d < rows.domains(); ++d)
    for (int i = rows.domain_start[d]; i < rows.domain_start[d + 1]; ++i)
      REQUIRE(rows.column[rows.row_start[i]] >= rows.domain_start[d]);
  for (int g = 0; g < rows.groups(); ++g)
    for (int i = rows.group_start[g]; i < rows.group_start[g + 1]; ++i)
      for (int k = rows.row_start[i]; k < rows.row_start[i + 1]; ++k)
        REQUIRE((rows.column[k] < rows.group_start.front() || rows.column[k] >= rows.group_start[g]));
}

TEST_CASE("the rows of domains are those of the matrix, and so are their columns", "[linear]") {
  RandomMotions random(6);
  const BlockMatrix matrix = grid(8, random);
  DomainRows rows;
  rows.build(matrix, 100);
  size_t blocks = 0;
  for (int i = 0; i < rows.size(); ++i) {
    CHECK(rows.column[rows.diagonal(i)] == i);
    for (int k = rows.row_start[i]; k < rows.row_start[i + 1]; ++k, ++blocks) {
      const int r = rows.vertex[i], c = rows.vertex[rows.column[k]];
      CHECK(matrix.find(std::max(r, c), std::min(r, c)) == rows.source[k].block);
      CHECK(rows.source[k].transposed == (r < c));
    }
    for (int k = rows.below_start[i]; k < rows.below_start[i + 1]; ++k) {
      const int row = rows.below_row[k], entry = rows.below_entry[k];
      CHECK(rows.column[entry] == i);
      CHECK((entry >= rows.row_start[row] && entry < rows.diagonal(row)));
    }
  }
  CHECK(blocks == matrix.row.size());
  CHECK(rows.below_row.size() == blocks - static_cast<size_t>(rows.size()));
}

// Two stiff, hardly supported bodies: the stiffness of rigid motions is 1e-6 of that of deformations, so that the residual hides rigid motions.
TEST_CASE("conjugate gradients solve for the translations of components", "[linear]") {
  RandomMotions random(8);
  const int n = 400;
  MatX chains = MatX::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    const bool end = i % 200 == 199;
    chains(i, i) += 1e-6;
    if (end) continue;
    chains(i, i) += 1;
    chains(i + 1, i + 1) += 1;
    chains(i, i + 1) = chains(i + 1, i) = -1;
  }
  chains(199, 200) = chains(200, 199) = -1e-7;  // and hardly coupled
  BlockMatrix matrix = scalar_blocks(chains, (1u << 30) + 3);
  VecX b = random.vectors(matrix.size());
  for (int part = 0; part < 2; ++part) {  // large forces that hardly add up to anything
    auto forces = b.segment(600 * part, 600).reshaped(3, 200);
    forces.colwise() += Vec3(Vec3::Constant(1e-4) - forces.rowwise().mean());
  }
  const VecX exact = dense(matrix).ldlt().solve(b);
  const auto momentum_error = [&](const std::string& translations) {
    const VecX x = solve(pcg("block_jacobi", "tolerance: 0.03, max_iterations: 2000, translations: " + translations), matrix, b).x;
    double worst = 0;
    for (int part = 0; part < 2; ++part) {
      const Vec3 error = (x - exact).segment(600 * part, 600).reshaped(3, 200).rowwise().sum();
      worst = std::max(worst, error.norm() / exact.segment(600 * part, 600).reshaped(3, 200).rowwise().sum().norm());
    }
    return worst;
  };
  CHECK(momentum_error("true") > 0.1);  // the matrix has no components
  matrix.component.assign(200, 0);
  matrix.component.resize(n, 1);
  CHECK(momentum_error("false") > 0.1);
  CHECK(momentum_error("true") < 0.01);
  matrix.component.assign(n, 0);  // components that are too small do not count
  for (int i = 0; i < n; ++i) matrix.component[i] = i / 8;
  CHECK(momentum_error("true") == momentum_error("false"));
}
