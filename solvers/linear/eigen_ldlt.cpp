// Eigen's simplicial LDL^T: no dense kernels, a second opinion on small problems.
#include <Eigen/SparseCholesky>

#include "solvers/linear/direct_solver.hpp"
#include "solvers/linear/scalar_csc.hpp"

namespace tack {

class EigenLdlt : public DirectSolver {
 public:
  bool factorize_blocks(const BlockMatrix& matrix, PhaseClock& clock) override {
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
    return solver_.info() == Eigen::Success && solver_.vectorD().minCoeff() > 0;
  }

  void solve_blocks(const VecX& b, VecX& x, PhaseClock& clock) override {
    const PhaseScope scope(clock, Phase::solve);
    x = solver_.solve(b);
  }

  int analyses() const override { return analyses_; }

 private:
  ScalarCsc csc_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver_;
  std::uint64_t version_ = 0;
  int analyses_ = 0;
};

TACK_REGISTER(LinearSolver, EigenLdlt, "eigen_ldlt",
              "Sparse LDL^T factorisation by Eigen, without dense kernels.",
              "Eigen 3.4, SimplicialLDLT");

}  // namespace tack
