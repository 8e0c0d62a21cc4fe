#include "solvers/path_following/indefinite_factor.hpp"

#include "geometry/errors.hpp"

namespace tack {

bool IndefiniteFactor::factorize(const BlockMatrix& matrix, PhaseClock& clock) {
  if (!matrix.modes.empty()) throw SimulationError("path_following: the Hessian of a term has global modes, which it cannot factorise; take that term out of the scene");
  const PhaseScope scope(clock, Phase::factorize);
  clock.count_factorization();
  const bool changed = matrix.version != version_;
  if (changed) csc_.set_structure(matrix);
  csc_.set_values(matrix);
  const int n = matrix.size();
  const Eigen::Map<const Eigen::SparseMatrix<double>> view(n, n, static_cast<Eigen::Index>(csc_.row.size()), csc_.column_start.data(), csc_.row.data(),
                                                           csc_.values.data());
  if (changed) solver_.analyzePattern(view);
  version_ = matrix.version;
  solver_.factorize(view);
  if (solver_.info() != Eigen::Success) return false;
  negative_pivots_ = static_cast<int>((solver_.vectorD().array() < 0).count());
  return solver_.vectorD().allFinite();
}

VecX IndefiniteFactor::solve(const VecX& b, PhaseClock& clock) const {
  const PhaseScope scope(clock, Phase::solve);
  return solver_.solve(b);
}

}  // namespace tack
