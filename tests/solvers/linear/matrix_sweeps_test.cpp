// Sweeps through a matrix that precondition and multiply at once, and conjugate gradients made of them.
#include "solvers/linear/matrix_sweeps.hpp"

#include <catch2/catch.hpp>

#include <Eigen/Eigenvalues>

#include "framework/core/linear_solver.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/linear_solve.hpp"
#include "tests/support/random_blocks.hpp"

using namespace tack;

namespace {

// M^-1 r.
VecX preconditioned(MatrixSweeps& sweeps, VecX r) {
  VecX z, x = VecX::Zero(r.size());
  sweeps.begin();
  sweeps.forward(0, x, r);
  sweeps.backward(z);
  return z;
}

}  // namespace

TEST_CASE("sweeps also compute the product with the matrix", "[linear]") {
  RandomMotions random(1);
  const BlockMatrix matrix = grid(12, random, 100);
  for (const int domain : {50, 200, 5000}) {
    INFO(domain);
    MatrixSweeps sweeps;
    REQUIRE(sweeps.update(matrix, domain, Deadline()));
    VecX r = random.vectors(matrix.size()), x = VecX::Zero(r.size()), last = x, product;
    const VecX more = random.vectors(matrix.size());
    sweeps.begin();
    double step = 0;
    for (const double ratio : {0.0, 0.7, 0.2}) {
      const VecX x_before = x, r_before = r;
      const double rz = sweeps.forward(step, x, r);
      if (step != 0) {
        const VecX direction = (x - x_before) / step;
        matrix.multiply(direction, product);
        CHECK((r_before - step * product - r).norm() < 1e-12 * product.norm());
        last = direction;
      }
      MatrixSweeps other;
      REQUIRE(other.update(matrix, domain, Deadline()));
      const VecX z = preconditioned(other, r), next = z + more + ratio * last;
      CHECK(rz == Approx(r.dot(z)).epsilon(1e-12));
      matrix.multiply(next, product);
      CHECK(sweeps.backward(ratio, more) == Approx(next.dot(product)).epsilon(1e-12));
      step = 0.3;
    }
  }
}

TEST_CASE("the preconditioner of sweeps is symmetric, definite and bounded by the matrix", "[linear]") {
  RandomMotions random(2);
  const BlockMatrix matrix = grid(4, random, 1e4);
  for (const int domain : {12, 5000}) {
    MatrixSweeps sweeps;
    REQUIRE(sweeps.update(matrix, domain, Deadline()));
    const MatX a = dense(matrix);
    MatX inverse(a.rows(), a.cols());
    for (Eigen::Index i = 0; i < a.cols(); ++i) inverse.col(i) = preconditioned(sweeps, VecX::Unit(a.cols(), i));
    CHECK((inverse - inverse.transpose()).norm() < 1e-11 * inverse.norm());
    const MatX root = a.llt().matrixL();
    const VecX values = Eigen::SelfAdjointEigenSolver<MatX>(root.transpose() * inverse * root, Eigen::EigenvaluesOnly).eigenvalues();
    CHECK(values.minCoeff() > 0);
    CHECK(values.maxCoeff() < 3);
    CHECK(values.maxCoeff() > 0.5);
  }
}

TEST_CASE("sweeps refuse a matrix with an indefinite diagonal block", "[linear]") {
  RandomMotions random(3);
  BlockMatrix matrix = grid(5, random);
  MatrixSweeps sweeps;
  CHECK(sweeps.update(matrix, 20, Deadline()));
  matrix.block(matrix.column_start[60])(1, 1) = -1;
  CHECK_FALSE(sweeps.update(matrix, 20, Deadline()));
}

TEST_CASE("corrections continue from the last solution", "[linear]") {
  RandomMotions random(4);
  const BlockMatrix matrix = grid(9, random, 1e3);
  const VecX b = random.vectors(matrix.size());
  const auto solver = component<LinearSolver>("{type: pcg, preconditioner: diagonal_cholesky, translations: false}");
  PhaseClock clock;
  VecX x, rest, product, correction;
  REQUIRE(solver->factorize(matrix, clock));
  solver->solve(b, x, clock);
  const int first = solver->iterations();
  matrix.multiply(x, product);
  rest = b - product;
  solver->correct(rest, correction, 1e-3, clock);
  const int more = solver->iterations();
  solver->set_tolerance(1e-5);
  solver->solve(b, x, clock);
  CHECK(first + more <= solver->iterations() + 2);  // as if it had not stopped
  const auto left = [&](const VecX& of) {
    matrix.multiply(correction, product);
    return (of - product).norm() / of.norm();
  };
  CHECK(left(rest) < 0.02);
  // Another right-hand side starts again, and so does the residual with another matrix.
  const VecX other = random.vectors(matrix.size());
  solver->correct(other, correction, 1e-6, clock);
  CHECK(left(other) < 1e-4);
  REQUIRE(solver->factorize(matrix, clock));
  solver->correct(rest, correction, 1e-6, clock);
  CHECK(left(rest) < 1e-4);
}
