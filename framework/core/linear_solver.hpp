// Solves A x = b for a symmetric positive definite block matrix.
#pragma once

#include <optional>
#include <string>

#include "framework/config/registry.hpp"
#include "framework/core/block_matrix.hpp"
#include "framework/core/phase_clock.hpp"

namespace tack {

/// Cost of a Cholesky factorisation, predicted from the pattern of the matrix alone.
struct FactorCost {
  double operations = 0;  // multiplications and additions of a factorisation
  double entries = 0;     // of L
};

/// Solver of block systems. Every call may throw OutOfTime (deadline.hpp); the data that the solver
/// keeps between systems are then cleared.
class LinearSolver : public Component {
 public:
  static constexpr const char* kind_name = "linear_solver";
  static constexpr const char* kind_doc = "Solves the Newton system A p = -g.";

  /// Factorises A. Returns false if A is not positive definite. Reuses the symbolic analysis while
  /// A.version stays the same.
  virtual bool factorize(const BlockMatrix& matrix, PhaseClock& clock) = 0;
  /// x <- A^-1 b with the last successful factorisation.
  virtual void solve(const VecX& b, VecX& x, PhaseClock& clock) = 0;
  /// x <- A^-1 b for a further right-hand side, a residual in iterative refinement, to the relative
  /// residual `relative`. Direct solvers ignore `relative`.
  virtual void correct(const VecX& b, VecX& x, double /*relative*/, PhaseClock& clock) {
    solve(b, x, clock);
  }
  /// columns <- A^-1 columns. Direct solvers may solve for several columns at once.
  virtual void solve_columns(Eigen::MatrixXd& columns, PhaseClock& clock) {
    VecX x;
    for (Eigen::Index i = 0; i < columns.cols(); ++i) {
      solve(columns.col(i), x, clock);
      columns.col(i) = x;
    }
  }
  virtual int analyses() const = 0;  // symbolic analyses so far

  /// Sets the relative residual of later solves. Direct solvers ignore it.
  virtual void set_tolerance(double /*relative*/) {}
  /// Announces that later systems may be indefinite. An indefinite system still counts as unsolved,
  /// but not as a failure of the solver.
  virtual void expect_indefinite(bool /*expected*/) {}
  virtual int iterations() const { return 0; }  // of the last solve

  /// Analyses the pattern of the matrix; returns nothing if the solver computes no factor.
  virtual std::optional<FactorCost> predict(const BlockMatrix& /*matrix*/, PhaseClock&) {
    return {};
  }
  /// Returns an upper bound of predict()'s cost in a fraction of its time: the cost of a
  /// minimum-degree ordering. Returns nothing if predict() does.
  virtual std::optional<FactorCost> bound(const BlockMatrix& matrix, PhaseClock& clock) {
    return predict(matrix, clock);
  }
  /// Names the method and the reason for its choice, in a few words, for the log.
  virtual std::string describe() const { return std::string(type()); }

  /// Approximate factors, for solvers that can trade accuracy for speed:
  ///   allow_approximation()  a preconditioner calls it once
  ///   exact()                true if the last factor solves to double precision nevertheless
  ///   sharpen()              requests exact factors from now on; false if that changes nothing
  virtual void allow_approximation() {}
  virtual bool exact() const { return true; }
  virtual bool sharpen() { return false; }
};

}  // namespace tack
