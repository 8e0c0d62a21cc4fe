// Our own Cholesky solver: SuiteSparse's ordering and analysis, a numeric factorisation that uses all
// threads. In single precision it costs half, and serves as a preconditioner.
#include <memory>
#include <optional>

#include "framework/core/linear_solver.hpp"
#include "solvers/linear/cholmod_analysis.hpp"
#include "solvers/linear/dense_kernels.hpp"
#include "solvers/linear/multifrontal_factor.hpp"

namespace tack {

class Multifrontal : public LinearSolver {
 public:
  enum class Precision { single, full };

  void fields(Fields& f) override {
    analysis_.fields(f);
    f.choice("precision", precision_,
             {{"single", Precision::single, "24 bits: half the time; only for a preconditioner"},
              {"double", Precision::full, "53 bits"}},
             "arithmetic of the factor");
  }

  bool factorize(const BlockMatrix& matrix, PhaseClock& clock) override {
    const PhaseScope scope(clock, Phase::factorize);
    blas::set_threads(1);
    if (analysis_.update(matrix, true)) tree_.emplace(*analysis_.factor(), matrix);
    if (precision_ == Precision::single && single_.factorize(*tree_, matrix)) {
      exact_ = false;
      return true;
    }
    exact_ = true;
    return double_.factorize(*tree_, matrix);
  }

  void solve(const VecX& b, VecX& x, PhaseClock& clock) override {
    const PhaseScope scope(clock, Phase::solve);
    if (exact_) {
      double_.solve(b, x);
    } else {
      single_.solve(b, x);
    }
  }

  bool exact() const override { return exact_; }
  bool sharpen() override {
    return !exact_ && std::exchange(precision_, Precision::full) == Precision::single;
  }
  int analyses() const override { return analysis_.count(); }

 private:
  Precision precision_ = Precision::full;
  CholmodAnalysis analysis_;
  std::optional<SupernodeTree> tree_;
  MultifrontalFactor<float> single_;
  MultifrontalFactor<double> double_;
  bool exact_ = true;  // of the last factor
};

TACK_REGISTER(LinearSolver, Multifrontal, "multifrontal",
              "Multifrontal sparse Cholesky factorisation on all threads, in single or double precision.",
              "Liu 1992, The Multifrontal Method for Sparse Matrix Solution");

}  // namespace tack
