#include "framework/sensitivity/tangent_system.hpp"

namespace tack {
namespace {

// Entries of a factor in double precision; above that, the default linear solver of the run is
// used.
constexpr double factor_entries_max = 1e8;
// Shifts, as fractions of the diagonal. In a quasi-static step with unconstrained directions, H is
// singular or slightly indefinite there, and r hardly has a component along them. The shifted H has
// a factor, which preconditions conjugate gradients: these solve for the soft directions and leave
// out the unconstrained ones.
constexpr double shifts[] = {1e-9, 1e-7, 1e-5};
constexpr int iterations_max = 30;
// Tolerance of iterative solves: their error is corrected as that of an older Hessian.
constexpr double solve_tolerance = 1e-5;

Eigen::SparseMatrix<double> lower_triangle(const BlockMatrix& matrix) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * matrix.row.size());
  for (int c = 0; c < matrix.columns(); ++c)
    for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          if (matrix.row[k] != c || i >= j) entries.emplace_back(3 * matrix.row[k] + i, 3 * c + j, matrix.block(k)(i, j));
  Eigen::SparseMatrix<double> lower(matrix.size(), matrix.size());
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

}  // namespace

void TangentSystem::begin(const SolvedStep& step) {
  current_ = false;
  if (step.unknowns == unknowns_) return;
  unknowns_ = step.unknowns;
  inertia_ = step.integrator.inertia();
  factored_ = false;
  shift_ = 0;
  definite_.reset();
}

bool TangentSystem::factorize(double shift) {
  shifted_ = matrix_;
  is_shifted_ = shift > 0;
  for (int c = 0; is_shifted_ && c < shifted_.columns(); ++c) {
    auto block = shifted_.block(shifted_.column_start[c]);
    block.diagonal() += Vec3::Constant(shift * block.diagonal().cwiseAbs().maxCoeff());
  }
  if (!definite_) {
    definite_ = Registry<LinearSolver>::make("multifrontal");
    const auto cost = definite_->predict(shifted_, clock_);
    if (cost && cost->entries > factor_entries_max) definite_ = Registry<LinearSolver>::make("auto");
    definite_->set_tolerance(solve_tolerance);
    definite_->expect_indefinite(true);
  }
  return definite_->factorize(shifted_, clock_);
}

void TangentSystem::refresh(StepPotential& potential) {
  matrix_ = potential.hessian({});
  ++factors_;
  factored_ = current_ = true;
  positive_ = inertia_ && factorize(0);
  while (!positive_ && shift_ < std::size(shifts) && !(positive_ = factorize(shifts[shift_]))) ++shift_;
  if (!positive_) factorize_indefinite();
}

void TangentSystem::factorize_indefinite() {
  positive_ = false;
  ++indefinite_;
  ldlt_.compute(lower_triangle(matrix_));
  if (ldlt_.info() == Eigen::Success) update_.prepare_any(matrix_.modes, [this](const VecX& b, VecX& x) { x = ldlt_.solve(b); });
}

// Improves d by conjugate gradients for the Hessian itself, preconditioned by the shifted factor.
// Returns false if the curvature is not positive in some direction.
bool TangentSystem::correct(const VecX& r, VecX& d) {
  VecX product, z, p;
  product_.multiply(matrix_, d, product);
  VecX residual = r - product;
  const double enough = solve_tolerance * r.norm();
  double before = 0;
  for (int i = 0; i < iterations_max && residual.norm() > enough; ++i) {
    definite_->solve(residual, z, clock_);
    const double now = residual.dot(z);
    p = i == 0 ? z : VecX(z + now / before * p);
    product_.multiply(matrix_, p, product);
    const double curvature = p.dot(product);
    if (!(curvature > 0) || !(now > 0)) return false;
    d += now / curvature * p;
    residual -= now / curvature * product;
    before = now;
  }
  return true;
}

void TangentSystem::solve(const VecX& r, VecX& d) {
  if (positive_) definite_->solve(r, d, clock_);
  // The iterative solver found negative curvature.
  if (positive_ && !d.allFinite()) factorize_indefinite();
  while (positive_ && is_shifted_ && !correct(r, d) && shift_ + 1 < std::size(shifts) && factorize(shifts[++shift_])) definite_->solve(r, d, clock_);
  if (positive_) return;
  if (ldlt_.info() == Eigen::Success) {
    d = ldlt_.solve(r);
    update_.apply(d);
  } else {
    d.setConstant(r.size(), std::numeric_limits<double>::quiet_NaN());
  }
}

}  // namespace tack
