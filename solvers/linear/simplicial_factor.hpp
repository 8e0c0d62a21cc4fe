// Sparse L D L^T of a block matrix by Eigen, without pivoting: of positive definite matrices
// (eigen_ldlt.cpp), and of indefinite ones (solvers/path_following), whose pivots count modes.
#pragma once

#include <Eigen/SparseCholesky>

#include "framework/core/phase_clock.hpp"
#include "solvers/linear/scalar_csc.hpp"

namespace tack {

class SimplicialFactor {
 public:
  // Returns false if a pivot is zero.
  bool factorize(const BlockMatrix& matrix, PhaseClock& clock) {
    const PhaseScope scope(clock, Phase::factorize);
    clock.count_factorization();
    const bool changed = matrix.version != version_;
    if (changed) csc_.set_structure(matrix);
    csc_.set_values(matrix);
    const int n = matrix.size();
    const Eigen::Map<const Eigen::SparseMatrix<double>> view(
        n, n, static_cast<Eigen::Index>(csc_.row.size()), csc_.column_start.data(), csc_.row.data(),
        csc_.values.data());
    if (changed) {
      solver_.analyzePattern(view);
      version_ = matrix.version;
      ++analyses_;
    }
    solver_.factorize(view);
    return solver_.info() == Eigen::Success;
  }
  VecX solve(const VecX& b, PhaseClock& clock) const {
    const PhaseScope scope(clock, Phase::solve);
    return solver_.solve(b);
  }
  // Returns D of the last factorisation.
  VecX pivots() const { return solver_.vectorD(); }
  int analyses() const { return analyses_; }

 private:
  ScalarCsc csc_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver_;
  std::uint64_t version_ = 0;
  int analyses_ = 0;
};

}  // namespace tack
