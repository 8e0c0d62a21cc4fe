// A metric for gradient methods: an approximation of H^-1 made once per minimisation from the
// clamped Hessian at its start.
#pragma once

#include <memory>
#include <vector>

#include "framework/core/linear_solver.hpp"
#include "framework/core/minimizer.hpp"

namespace tack {

/// Metric made by begin() from the clamped Hessian at the start of a minimisation.
class StartPreconditioner {
 public:
  enum class Kind { elastic, full, block_diagonal };
  explicit StartPreconditioner(Kind kind = Kind::full) : kind_(kind) {}

  void fields(Fields& f);
  /// Makes the metric. Returns false if the Hessian is singular.
  bool begin(const MinimizerProblem& problem, MinimizerResult& result);
  void apply(const VecX& v, VecX& out, PhaseClock& clock);  ///< out <- B^-1 v

 private:
  Kind kind_;
  std::unique_ptr<LinearSolver> linear_ = Registry<LinearSolver>::make("multifrontal");
  std::vector<Mat3> inverse_;  // of the diagonal blocks
};

}  // namespace tack
