// Chooses between a factor that is kept and conjugate gradients with an incomplete one, by what they
// read and compute: the operations and entries of the factor as its symbolic analysis predicts them,
// against the blocks of the matrix and the iterations that were needed. Counts, not seconds, so that
// runs repeat bit for bit; the constants are measured, see docs/log/performance_linear_solvers.md.
#include <fmt/format.h>

#include <limits>
#include <memory>

#include "framework/config/field.hpp"
#include "framework/core/linear_solver.hpp"

namespace tack {

class AutomaticSolver : public LinearSolver {
 public:
  void fields(Fields& f) override {
    f.component("direct", direct_, "solver if a factorisation is cheap or many iterations are needed");
    f.component("iterative", iterative_, "solver if a factorisation is expensive");
  }

  bool factorize(const BlockMatrix& matrix, PhaseClock& clock) override {
    matrix_ = &matrix;
    if (matrix.size() > 1.25 * decided_for_ || 1.25 * matrix.size() < decided_for_) {
      begin(clock);
    } else {
      iterating_ = next_iterates_;
    }
    if (iterating_ && iterative_->factorize(matrix, clock)) return true;
    if (iterating_ && maybe_indefinite_) return false;
    if (iterating_) stop_iterating("its preconditioner broke down");
    const bool definite = direct_->factorize(matrix, clock);
    weigh_anew(clock);
    return definite;
  }

  void solve(const VecX& b, VecX& x, PhaseClock& clock) override {
    if (!iterating_) {
      direct_->solve(b, x, clock);
      return weigh_anew(clock);
    }
    iterative_->solve(b, x, clock);
    judge(b, x, clock);
  }

  void correct(const VecX& b, VecX& x, double relative, PhaseClock& clock) override {
    if (!iterating_) return direct_->correct(b, x, relative, clock);
    iterative_->correct(b, x, relative, clock);
    if (!x.allFinite() && !maybe_indefinite_) give_up(b, x, clock);
  }

  void set_tolerance(double relative) override {
    direct_->set_tolerance(relative);
    iterative_->set_tolerance(relative);
  }
  void expect_indefinite(bool maybe) override { maybe_indefinite_ = maybe; }
  int iterations() const override { return iterating_ ? iterative_->iterations() : direct_->iterations(); }
  int analyses() const override { return direct_->analyses(); }
  std::string describe() const override { return reason_; }

 private:
  // For a system of another size.
  void begin(PhaseClock& clock) {
    decided_for_ = matrix_->size();
    needed_ = expected;
    experience_.clear();
    reason_ = direct_->describe();
    weigh(direct_->predict(*matrix_, clock));
    iterating_ = next_iterates_;
  }

  // Contacts fill a factor: whenever it was analysed anew, what it costs is known anew.
  void weigh_anew(PhaseClock& clock) {
    if (direct_->analyses() != analyses_ && direct_->analyses() > 0) weigh(direct_->predict(*matrix_, clock));
  }

  void weigh(const std::optional<FactorCost>& cost) {
    analyses_ = direct_->analyses();
    next_iterates_ = false;
    if (!cost) return;
    const double blocks = matrix_->blocks(), pass = cost->entries + per_unknown * matrix_->size() + product * blocks;
    budget_ = std::max(0.0, (operation * cost->operations + passes * pass) / (per_block * blocks) - incomplete_factor);
    next_iterates_ = budget_ > needed_ && matrix_->size() > smallest;
    solves_ = 0;
    average_ = 0;
    if (!next_iterates_ && !experience_.empty()) return;  // the reason stands
    reason_ = fmt::format("{} ({} unknowns; a factor has {:.2g} entries and takes {:.2g} operations, as much as "
                          "{:.0f} iterations of {}{})",
                          next_iterates_ ? iterative_->describe() : direct_->describe(), matrix_->size(),
                          cost->entries, cost->operations, budget_, iterative_->describe(), experience_);
  }

  // The cost of finding x.
  void judge(const VecX& b, VecX& x, PhaseClock& clock) {
    const bool unsolved = !x.allFinite();
    if (unsolved && maybe_indefinite_ && iterative_->iterations() <= hopeless * budget_) return;
    if (unsolved) return give_up(b, x, clock);
    solves_ = std::min(solves_ + 1, memory);
    average_ += (iterative_->iterations() - average_) / solves_;
    if ((solves_ >= trial && average_ > patience * budget_) || iterative_->iterations() > hopeless * budget_) tire();
  }

  // The next system is another solver's; this one may still have to be corrected.
  void tire() {
    next_iterates_ = false;
    needed_ = std::max(needed_, again * average_);
    experience_ = fmt::format("; they were {:.0f} a system", average_);
    reason_ = fmt::format("{} (in place of {}: it took {:.0f} iterations a system, a factor costs as much as {:.0f})",
                          direct_->describe(), iterative_->describe(), average_, budget_);
  }

  void give_up(const VecX& b, VecX& x, PhaseClock& clock) {
    stop_iterating("it did not converge");
    if (direct_->factorize(*matrix_, clock)) direct_->solve(b, x, clock);
  }

  // For good, or until there is a system of another size.
  void stop_iterating(const std::string& why) {
    iterating_ = next_iterates_ = false;
    needed_ = std::numeric_limits<double>::infinity();
    experience_ = "; " + why;
    reason_ = fmt::format("{} (in place of {}: {})", direct_->describe(), iterative_->describe(), why);
  }

  // In units of the time that it takes to read an entry of a factor of single precision there and back.
  static constexpr double operation = 0.03;   // of a factorisation, which serves several systems
  static constexpr double passes = 4.3;       // through the factor for each system
  static constexpr double per_unknown = 150;  // of a pass: nodes are small
  static constexpr double product = 10;       // a block of the matrix, once a pass
  static constexpr double per_block = 26;     // an iteration: product and incomplete factor
  static constexpr double incomplete_factor = 5.5;  // iterations that it costs
  static constexpr double expected = 9;       // iterations that a system may well take
  static constexpr int smallest = 1000;       // unknowns: any solver will do for fewer
  static constexpr double patience = 1.6;     // times the budget: what a kept factor costs is not known well
  static constexpr double again = 1.5;        // times the iterations that were too many: a budget to try them again
  static constexpr int trial = 4;             // systems before iterations are judged
  static constexpr double hopeless = 5;       // times the budget: a single system is enough to tell
  static constexpr int memory = 16;           // systems that their average goes over

  std::unique_ptr<LinearSolver> direct_ = Registry<LinearSolver>::make("lagged_cholesky");
  std::unique_ptr<LinearSolver> iterative_ = Registry<LinearSolver>::make("pcg");

  const BlockMatrix* matrix_ = nullptr;
  bool iterating_ = false;
  bool next_iterates_ = false;  // from the next system on
  double needed_ = expected;    // the least budget to iterate
  int analyses_ = -1;           // of the direct solver, when it was weighed
  std::string experience_;      // with iterating, if it was not good
  bool maybe_indefinite_ = false;  // systems from now on
  double decided_for_ = 0;  // unknowns
  double budget_ = 0;       // iterations that cost as much as the factor
  double average_ = 0;      // iterations of recent systems
  int solves_ = 0;
  std::string reason_ = "auto";
};

TACK_REGISTER(LinearSolver, AutomaticSolver, "auto",
              "A lagged Cholesky factor or conjugate gradients, whichever should be faster.",
              "predicted operations and fill against counted iterations");

}  // namespace tack
