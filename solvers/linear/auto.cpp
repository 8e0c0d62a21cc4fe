// Chooses between a reused Cholesky factor and conjugate gradients with an incomplete factor, by
// predicted reads and operations: entries and operations of the factor, against blocks of the
// matrix and iterations needed so far. Bounds of the factor's cost decide where they suffice; the
// symbolic analysis, which takes ten times as long, where they do not. The decision counts
// operations, not seconds, so that runs repeat bit for bit. The constants are measured:
// docs/log/performance_linear_solvers.md.
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
  // Decides again for a system of another size.
  void begin(PhaseClock& clock) {
    decided_for_ = matrix_->size();
    needed_ = expected;
    experience_.clear();
    reason_ = direct_->describe();
    const std::optional<FactorCost> bound = direct_->bound(*matrix_, clock);
    if (bound && worth_iterating(budget(least(*bound)))) {
      weigh(least(*bound), false);
    } else {
      weigh(direct_->predict(*matrix_, clock), true);
    }
    iterating_ = next_iterates_;
  }

  // Returns the least cost of the best ordering, for the cost of a minimum-degree ordering.
  static FactorCost least(const FactorCost& bound) {
    return {bound.operations / operations_saved, bound.entries / entries_saved};
  }

  // Returns the iterations that cost as much as a factor.
  double budget(const FactorCost& cost) const {
    const double blocks = matrix_->blocks(), pass = cost.entries + per_unknown * matrix_->size() + product * blocks;
    return std::max(0.0, (operation * cost.operations + passes * pass) / (per_block * blocks) - incomplete_factor);
  }
  bool worth_iterating(double budget) const { return budget > needed_ && matrix_->size() > smallest; }

  // Predicts the cost of the factor again after each new analysis, because contacts fill it.
  void weigh_anew(PhaseClock& clock) {
    if (direct_->analyses() != analyses_ && direct_->analyses() > 0) weigh(direct_->predict(*matrix_, clock), true);
  }

  // exact: the cost is that of the symbolic analysis, not a lower bound.
  void weigh(const std::optional<FactorCost>& cost, bool exact) {
    analyses_ = direct_->analyses();
    next_iterates_ = false;
    if (!cost) return;
    budget_ = budget(*cost);
    exact_ = exact;
    next_iterates_ = worth_iterating(budget_);
    solves_ = 0;
    average_ = 0;
    if (!next_iterates_ && !experience_.empty()) return;  // the reason of the last decision holds
    reason_ = fmt::format("{} ({} unknowns; a factor has {}{:.2g} entries and takes {:.2g} operations, as much as "
                          "{:.0f} iterations of {}{})",
                          next_iterates_ ? iterative_->describe() : direct_->describe(), matrix_->size(),
                          exact ? "" : "at least ", cost->entries, cost->operations, budget_, iterative_->describe(), experience_);
  }

  // Returns true if iterations exceed a multiple of the budget. Analyses the matrix only if the
  // lower bound of the budget is exceeded.
  bool exceeds(double iterations, double multiple, PhaseClock& clock) {
    if (iterations > multiple * budget_ && !exact_) {
      if (const auto cost = direct_->predict(*matrix_, clock)) budget_ = budget(*cost);
      analyses_ = direct_->analyses();
      exact_ = true;
    }
    return iterations > multiple * budget_;
  }

  // Records the iterations that finding x took, and whether they were too many.
  void judge(const VecX& b, VecX& x, PhaseClock& clock) {
    const bool unsolved = !x.allFinite();
    if (unsolved && maybe_indefinite_ && !exceeds(iterative_->iterations(), hopeless, clock)) return;
    if (unsolved) return give_up(b, x, clock);
    solves_ = std::min(solves_ + 1, memory);
    average_ += (iterative_->iterations() - average_) / solves_;
    if ((solves_ >= trial && exceeds(average_, patience, clock)) || exceeds(iterative_->iterations(), hopeless, clock)) tire();
  }

  // Switches the next system to the direct solver; this system may still need a correction.
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

  // Stops iterating until the size of the system changes.
  void stop_iterating(const std::string& why) {
    iterating_ = next_iterates_ = false;
    needed_ = std::numeric_limits<double>::infinity();
    experience_ = "; " + why;
    reason_ = fmt::format("{} (in place of {}: {})", direct_->describe(), iterative_->describe(), why);
  }

  // Costs in units of the time to read an entry of a single-precision factor twice (forward and
  // backward).
  // per operation of a factorisation, which serves several systems
  static constexpr double operation = 0.03;
  static constexpr double passes = 4.3;       // passes through the factor per system
  static constexpr double per_unknown = 150;  // per unknown and pass: nodes are small
  static constexpr double product = 10;       // per block of the matrix and pass
  static constexpr double per_block = 26;  // per block and iteration: product and incomplete factor
  // Iterations that cost as much as the incomplete factor.
  static constexpr double incomplete_factor = 5.5;
  static constexpr double expected = 9;       // iterations that a system is assumed to take
  // Largest ratios of a minimum-degree factor's cost to that of the best ordering: of a box of 64^3
  // cells 3.7 and 1.9, of smaller boxes and of sheets less.
  static constexpr double operations_saved = 4, entries_saved = 2;
  static constexpr int smallest = 1000;       // unknowns, below which any solver will do
  // Factor on the budget: the cost of a reused factor is uncertain.
  static constexpr double patience = 1.6;
  // Factor on iterations that were too many: the budget at which iterating is tried again.
  static constexpr double again = 1.5;
  static constexpr int trial = 4;             // systems before iterations are judged
  // Factor on the budget above which one system is enough to stop.
  static constexpr double hopeless = 5;
  static constexpr int memory = 16;           // systems of the running average

  std::unique_ptr<LinearSolver> direct_ = Registry<LinearSolver>::make("lagged_cholesky");
  std::unique_ptr<LinearSolver> iterative_ = Registry<LinearSolver>::make("pcg");

  const BlockMatrix* matrix_ = nullptr;
  bool iterating_ = false;
  bool next_iterates_ = false;  // from the next system on
  double needed_ = expected;    // smallest budget at which iterating is tried
  int analyses_ = -1;           // analyses of the direct solver at the last prediction
  std::string experience_;      // reason why iterating was stopped, if it was
  bool maybe_indefinite_ = false;  // systems from now on may be indefinite
  double decided_for_ = 0;  // unknowns
  double budget_ = 0;       // iterations that cost as much as the factor, or fewer
  bool exact_ = false;      // the budget is predicted by the symbolic analysis
  double average_ = 0;      // average iterations of recent systems
  int solves_ = 0;
  std::string reason_ = "auto";
};

TACK_REGISTER(LinearSolver, AutomaticSolver, "auto",
              "A lagged Cholesky factor or conjugate gradients, whichever should be faster.",
              "predicted operations and fill against counted iterations");

}  // namespace tack
