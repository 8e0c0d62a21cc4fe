#include "solvers/minimizers/start_preconditioner.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "framework/config/field.hpp"
#include "geometry/parallel.hpp"
#include "solvers/minimizers/shifted_factor.hpp"

namespace tack {

void StartPreconditioner::fields(Fields& f) {
  f.choice("metric", kind_,
           {{"elastic", Kind::elastic, "inertia and elasticity at the start of the solve, factorised"},
            {"full", Kind::full, "contact and friction too, factorised"},
            {"block_diagonal", Kind::block_diagonal, "the 3x3 diagonal blocks of the full one"}},
           "approximation of the Hessian");
  f.component("linear", linear_, "solver that factorises");
}

bool StartPreconditioner::begin(const MinimizerProblem& problem, MinimizerResult& result) {
  Objective& objective = problem.objective;
  const BlockMatrix& hessian =
      objective.hessian({.projection = Projection::clamp, .without_dynamic = kind_ == Kind::elastic});
  if (kind_ != Kind::block_diagonal) {
    VecX p;
    return shifted_solve(*linear_, hessian, objective.gradient(), p, problem.clock, result).has_value();
  }
  inverse_.resize(hessian.columns());
  for_each(hessian.columns(), [&](int c) {
    inverse_[c] = hessian.block(hessian.column_start[c]).inverse();
  });
  return std::all_of(inverse_.begin(), inverse_.end(), [](const Mat3& m) { return m.allFinite(); });
}

void StartPreconditioner::apply(const VecX& v, VecX& out, PhaseClock& clock) {
  if (kind_ != Kind::block_diagonal) return linear_->solve(v, out, clock);
  const PhaseScope scope(clock, Phase::solve);
  out.resize(v.size());
  for_each(static_cast<int>(inverse_.size()),
           [&](int c) { out.segment<3>(3 * c) = inverse_[c] * v.segment<3>(3 * c); });
}

}  // namespace tack
