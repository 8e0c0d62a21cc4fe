// Solves A x = b for a symmetric positive definite block matrix.
#pragma once

#include <optional>
#include <string>

#include "framework/config/registry.hpp"
#include "framework/core/block_matrix.hpp"
#include "framework/core/phase_clock.hpp"

namespace tack {

// What a Cholesky factor costs, predicted from the pattern of the matrix alone.
struct FactorCost {
  double operations = 0;  // multiplications and additions of a factorisation
  double entries = 0;     // of L
};

// Throws OutOfTime where the clock's deadline passes; what is kept from system to system then is as if there had been
// none before.
class LinearSolver : public Component {
 public:
  static constexpr const char* kind_name = "linear_solver";
  static constexpr const char* kind_doc = "Solves the Newton system A p = -g.";

  // Factorises A; false if A is not positive definite. Reuses the symbolic analysis while
  // A.version stays the same.
  virtual bool factorize(const BlockMatrix& matrix, PhaseClock& clock) = 0;
  // x <- A^-1 b with the last successful factorisation.
  virtual void solve(const VecX& b, VecX& x, PhaseClock& clock) = 0;
  // The same once more for another b, leaving at most `relative` of it: what corrects a solution that
  // iterations stopped short of. Direct solvers need no such leave.
  virtual void correct(const VecX& b, VecX& x, double /*relative*/, PhaseClock& clock) { solve(b, x, clock); }
  // columns <- A^-1 columns. Direct solvers may take several at once.
  virtual void solve_columns(Eigen::MatrixXd& columns, PhaseClock& clock) {
    VecX x;
    for (Eigen::Index i = 0; i < columns.cols(); ++i) {
      solve(columns.col(i), x, clock);
      columns.col(i) = x;
    }
  }
  virtual int analyses() const = 0;  // symbolic analyses so far

  // The relative residual that solves may leave from now on, for solvers that iterate; direct ones
  // need no such leave.
  virtual void set_tolerance(double /*relative*/) {}
  // Whether systems from now on may be indefinite. Such a system counts as unsolved all the same, but the solver
  // is not to blame.
  virtual void expect_indefinite(bool /*expected*/) {}
  virtual int iterations() const { return 0; }  // of the last solve

  // Analyses the matrix's pattern; nothing from solvers that make no factor.
  virtual std::optional<FactorCost> predict(const BlockMatrix& /*matrix*/, PhaseClock&) { return {}; }
  // What solves and why, in a few words, once it is known: for the log.
  virtual std::string describe() const { return std::string(type()); }

  // For solvers that can trade accuracy for speed. A preconditioner calls allow_approximation() once;
  // exact() tells whether the last factor solves to double precision nevertheless; sharpen() asks that
  // later ones do, and is false if that would change nothing.
  virtual void allow_approximation() {}
  virtual bool exact() const { return true; }
  virtual bool sharpen() { return false; }
};

}  // namespace tack
