// CHOLMOD's supernodal Cholesky (Chen et al. 2008). The fill-reducing ordering is found on the graph
// of 3x3 blocks, nine times smaller than the matrix: the best of AMD and METIS by predicted
// operations. It is kept while the pattern changes little (contacts coming and going); the symbolic
// analysis is redone only when the pattern does change.
#include <omp.h>

#include <memory>

#include "framework/config/field.hpp"
#include "framework/core/linear_solver.hpp"
#include "solvers/linear/cholmod_session.hpp"
#include "solvers/linear/scalar_csc.hpp"

extern "C" void openblas_set_num_threads(int threads);

namespace tack {

class Cholmod : public LinearSolver {
 public:
  enum class Ordering { best, amd, metis };

  void fields(Fields& f) override {
    f.choice("ordering", ordering_,
             {{"best", Ordering::best, "the cheaper of the two by predicted operations"},
              {"amd", Ordering::amd, "approximate minimum degree"},
              {"metis", Ordering::metis, "nested dissection"}},
             "fill-reducing ordering");
    f.flag("supernodal", supernodal_, "supernodal rather than simplicial factorisation");
    f.integer("blas_threads", blas_threads_,
              "threads of the dense kernels; above 1 the bits may depend on it").at_least(1);
  }

  bool factorize(const BlockMatrix& matrix, PhaseClock& clock) override {
    const PhaseScope scope(clock, Phase::factorize);
    configure();
    if (matrix.version != version_ || !factor_) analyze(matrix);
    csc_.set_values(matrix);
    cholmod_sparse view = lower_view(matrix.size(), csc_.column_start, csc_.row, csc_.values.data());
    cholmod_factorize(&view, factor_.get(), common_.get());
    return common_->status == CHOLMOD_OK && factor_->minor == factor_->n;
  }

  void solve(const VecX& b, VecX& x, PhaseClock& clock) override {
    const PhaseScope scope(clock, Phase::solve);
    cholmod_dense right{};
    right.nrow = right.d = right.nzmax = static_cast<size_t>(b.size());
    right.ncol = 1;
    right.x = const_cast<double*>(b.data());
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    work_.solve(factor_.get(), &right, common_.get());
    x = Eigen::Map<const VecX>(static_cast<const double*>(work_.solution->x), b.size());
  }

  int analyses() const override { return analyses_; }

 private:
  void configure() {
    openblas_set_num_threads(blas_threads_);
    // CHOLMOD's own OpenMP loops ask for four threads and spin: twice as slow as none.
    omp_set_max_active_levels(0);
    common_->print = 0;
    common_->supernodal = supernodal_ ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
    common_->final_ll = 1;
    common_->nmethods = 1;
    common_->method[0].ordering = CHOLMOD_GIVEN;
    common_->postorder = 1;
    common_->quick_return_if_not_posdef = 1;
  }

  void analyze(const BlockMatrix& matrix) {
    csc_.set_structure(matrix);
    const bool same_size = permutation_.size() == static_cast<size_t>(matrix.size());
    factor_ = same_size ? analyze_with(permutation_, matrix.size()) : nullptr;
    constexpr double tolerated_growth = 1.3;
    if (!factor_ || common_->fl > tolerated_growth * operations_) order(matrix);
    version_ = matrix.version;
    ++analyses_;
  }

  FactorPtr analyze_with(std::vector<int>& permutation, int n) {
    cholmod_sparse view = lower_view(n, csc_.column_start, csc_.row, nullptr);
    return {cholmod_analyze_p(&view, permutation.data(), nullptr, 0, common_.get()),
            FactorDeleter{common_.get()}};
  }

  // Orders the graph of blocks and keeps the cheapest.
  void order(const BlockMatrix& matrix) {
    const int n = matrix.columns();
    auto start = matrix.column_start;
    auto rows = matrix.row;
    cholmod_sparse graph = lower_view(n, start, rows, nullptr);
    factor_ = nullptr;
    for (const Ordering choice : {Ordering::amd, Ordering::metis}) {
      if (ordering_ != Ordering::best && ordering_ != choice) continue;
      std::vector<int> block_order(n);
      const bool ok = choice == Ordering::amd
                          ? cholmod_amd(&graph, nullptr, 0, block_order.data(), common_.get())
                          : cholmod_metis(&graph, nullptr, 0, 1, block_order.data(), common_.get());
      if (!ok) continue;
      std::vector<int> order(3 * n);
      for (int k = 0; k < 3 * n; ++k) order[k] = 3 * block_order[k / 3] + k % 3;
      FactorPtr factor = analyze_with(order, 3 * n);
      if (!factor || (factor_ && common_->fl >= operations_)) continue;
      operations_ = common_->fl;
      permutation_ = std::move(order);
      factor_ = std::move(factor);
    }
  }

  Ordering ordering_ = Ordering::best;
  bool supernodal_ = true;
  int blas_threads_ = 1;

  CholmodSession common_;
  SolveWork work_{common_.get()};
  ScalarCsc csc_;
  std::vector<int> permutation_;
  FactorPtr factor_;
  double operations_ = 0;  // predicted for the ordering when it was made
  std::uint64_t version_ = 0;
  int analyses_ = 0;
};

TACK_REGISTER(LinearSolver, Cholmod, "cholmod",
              "Sparse Cholesky factorisation by SuiteSparse's CHOLMOD.",
              "Chen, Davis, Hager, Rajamanickam 2008, Algorithm 887");

}  // namespace tack
