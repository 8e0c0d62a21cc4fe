#include "framework/sensitivity/tangent_system.hpp"

namespace tack {
namespace {

constexpr double largest_factor = 1e8;  // entries, of one in double precision: above that, what the run's solvers take by default
// Of what nothing holds in some direction, quasi-static, H is singular there, and so is r. A part of the diagonal that hardly
// slows down the corrections of anything else keeps rounding from being taken for a way.
constexpr double shifts[] = {1e-9, 1e-7};
constexpr double solved_to = 1e-5;  // of solves that iterate: what they leave is corrected as what an older Hessian leaves

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
  fresh_ = false;
  if (step.unknowns == unknowns_) return;
  unknowns_ = step.unknowns;
  inertia_ = step.integrator.predict(step.start, step.h).inertia;
  factored_ = false;
  definite_.reset();
}

bool TangentSystem::factorize(double shift) {
  for (int c = 0; shift > 0 && c < matrix_.columns(); ++c) {
    auto block = matrix_.block(matrix_.column_start[c]);
    block.diagonal() += Vec3::Constant(shift * block.diagonal().cwiseAbs().maxCoeff());
  }
  if (!definite_) {
    definite_ = Registry<LinearSolver>::make("multifrontal");
    const auto cost = definite_->predict(matrix_, clock_);
    if (cost && cost->entries > largest_factor) definite_ = Registry<LinearSolver>::make("auto");
    definite_->set_tolerance(solved_to);
    definite_->expect_indefinite(true);
  }
  return definite_->factorize(matrix_, clock_);
}

void TangentSystem::refresh(StepPotential& potential) {
  matrix_ = potential.hessian({});
  ++factors_;
  factored_ = fresh_ = true;
  positive_ = factorize(inertia_ ? 0 : shifts[0]) || factorize(shifts[1]);
  if (!positive_) take_as_it_is();
}

void TangentSystem::take_as_it_is() {
  positive_ = false;
  ++indefinite_;
  ldlt_.compute(lower_triangle(matrix_));
}

void TangentSystem::solve(const VecX& r, VecX& d) {
  if (positive_) definite_->solve(r, d, clock_);
  if (positive_ && !d.allFinite()) take_as_it_is();  // iterations found that it is not
  if (positive_) return;
  if (ldlt_.info() == Eigen::Success) d = ldlt_.solve(r);
  else d.setConstant(r.size(), std::numeric_limits<double>::quiet_NaN());
}

}  // namespace tack
