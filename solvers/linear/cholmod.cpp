// CHOLMOD's supernodal Cholesky (Chen et al. 2008), in double precision on one thread.
#include <omp.h>

#include <memory>

#include "solvers/linear/cholmod_analysis.hpp"
#include "solvers/linear/dense_kernels.hpp"
#include "solvers/linear/direct_solver.hpp"

namespace tack {

class Cholmod : public DirectSolver {
 public:
  void fields(Fields& f) override {
    analysis_.fields(f);
    f.flag("supernodal", supernodal_, "supernodal rather than simplicial factorisation");
    f.integer("blas_threads", blas_threads_,
              "threads of the dense kernels; above 1 the bits may depend on it").at_least(1);
  }

  bool factorize_blocks(const BlockMatrix& matrix, PhaseClock& clock) override {
    const PhaseScope scope(clock, Phase::factorize);
    clock.count_factorization();
    blas::set_threads(blas_threads_);
    // CHOLMOD's own OpenMP loops ask for four threads and spin, which takes twice the time of one
    // thread.
    omp_set_max_active_levels(0);
    analysis_.update(matrix, supernodal_ ? CholmodAnalysis::Kind::supernodal : CholmodAnalysis::Kind::simplicial);
    ScalarCsc& csc = analysis_.csc();
    csc.set_values(matrix);
    cholmod_sparse view = lower_view(matrix.size(), csc.column_start, csc.row, csc.values.data());
    cholmod_common* common = analysis_.common();
    cholmod_factorize(&view, analysis_.factor(), common);
    return common->status == CHOLMOD_OK && analysis_.factor()->minor == analysis_.factor()->n;
  }

  void solve_blocks(const VecX& b, VecX& x, PhaseClock& clock) override {
    const PhaseScope scope(clock, Phase::solve);
    x = Eigen::Map<const VecX>(solution(b.data(), b.size(), 1), b.size());
  }
  void solve_block_columns(Eigen::MatrixXd& columns, PhaseClock& clock) override {
    const PhaseScope scope(clock, Phase::solve);
    columns = Eigen::Map<const Eigen::MatrixXd>(solution(columns.data(), columns.rows(), columns.cols()), columns.rows(), columns.cols());
  }

  int analyses() const override { return analysis_.count(); }

 private:
  // Solves for `count` right-hand sides, stored one after the other.
  const double* solution(const double* b, Eigen::Index rows, Eigen::Index count) {
    cholmod_dense right{};
    right.nrow = right.d = static_cast<size_t>(rows);
    right.ncol = static_cast<size_t>(count);
    right.nzmax = right.nrow * right.ncol;
    right.x = const_cast<double*>(b);
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    work_.solve(analysis_.factor(), &right, analysis_.common());
    return static_cast<const double*>(work_.solution->x);
  }

  CholmodAnalysis analysis_;
  SolveWork work_{analysis_.common()};
  bool supernodal_ = true;
  int blas_threads_ = 1;
};

TACK_REGISTER(LinearSolver, Cholmod, "cholmod",
              "Sparse Cholesky factorisation by SuiteSparse's CHOLMOD.",
              "Chen, Davis, Hager, Rajamanickam 2008, Algorithm 887");

}  // namespace tack
