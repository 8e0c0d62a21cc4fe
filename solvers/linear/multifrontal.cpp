// Multifrontal Cholesky solver: SuiteSparse's ordering and analysis, and a numeric factorisation on
// all threads. Single precision halves its cost; the factor then serves as a preconditioner.
#include <memory>
#include <optional>

#include "solvers/linear/cholmod_analysis.hpp"
#include "solvers/linear/dense_kernels.hpp"
#include "solvers/linear/direct_solver.hpp"
#include "solvers/linear/multifrontal_factor.hpp"

namespace tack {

class Multifrontal : public DirectSolver {
 public:
  enum class Precision { automatic, single, full };

  void fields(Fields& f) override {
    analysis_.fields(f);
    f.choice("precision", precision_,
             {{"automatic", Precision::automatic, "single as a preconditioner, double otherwise"},
              {"single", Precision::single, "24 bits: about half the time"},
              {"double", Precision::full, "53 bits"}},
             "arithmetic of the factor");
  }

  bool factorize_blocks(const BlockMatrix& matrix, PhaseClock& clock) override {
    const PhaseScope scope(clock, Phase::factorize);
    clock.count_factorization();
    blas::set_threads(1);
    analyze(matrix);
    if (outdated_) tree_.emplace(*analysis_.factor(), matrix);
    outdated_ = false;
    if (approximate() && single_.factorize(*tree_, matrix, clock.deadline())) {
      exact_ = false;
      return true;
    }
    exact_ = true;
    return double_.factorize(*tree_, matrix, clock.deadline());
  }

  void solve_blocks(const VecX& b, VecX& x, PhaseClock& clock) override {
    const PhaseScope scope(clock, Phase::solve);
    if (exact_) {
      double_.solve(b, x);
    } else {
      single_.solve(b, x);
    }
  }

  void allow_approximation() override { preconditioner_ = true; }
  bool exact() const override { return exact_; }
  bool sharpen() override {
    if (!approximate() || exact_) return false;
    precision_ = Precision::full;
    return true;
  }
  int analyses() const override { return analysis_.count(); }

  std::optional<FactorCost> predict(const BlockMatrix& matrix, PhaseClock& clock) override {
    const PhaseScope scope(clock, Phase::factorize);
    analyze(matrix);
    return analysis_.cost();
  }
  std::optional<FactorCost> bound(const BlockMatrix& matrix, PhaseClock& clock) override {
    if (!analysis_.compares_amd()) return predict(matrix, clock);
    const PhaseScope scope(clock, Phase::factorize);
    return analysis_.bound(matrix);
  }

 private:
  // Updates the analysis. The tree belongs to the present factor and is rebuilt with the next one.
  void analyze(const BlockMatrix& matrix) {
    if (analysis_.update(matrix, CholmodAnalysis::Kind::supernodal_blocks)) outdated_ = true;
  }

  bool approximate() const {
    return precision_ == Precision::single || (precision_ == Precision::automatic && preconditioner_);
  }

  Precision precision_ = Precision::automatic;
  bool preconditioner_ = false;
  CholmodAnalysis analysis_;
  std::optional<SupernodeTree> tree_;
  bool outdated_ = false;  // the pattern of the analysis is newer than the tree's
  MultifrontalFactor<float> single_;
  MultifrontalFactor<double> double_;
  bool exact_ = true;  // the last factor is in double precision
};

TACK_REGISTER(LinearSolver, Multifrontal, "multifrontal",
              "Multifrontal sparse Cholesky factorisation on all threads, in single or double precision.",
              "Liu 1992, The Multifrontal Method for Sparse Matrix Solution");

}  // namespace tack
