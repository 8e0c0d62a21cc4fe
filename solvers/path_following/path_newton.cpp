#include "solvers/path_following/path_newton.hpp"

#include <algorithm>
#include <cmath>

#include "framework/stepping/time_config.hpp"

namespace tack {
namespace {

constexpr int max_iterations = 30;             // quadratic convergence takes fewer than ten; damage that starts or ends takes some more
constexpr double length_tolerance = 1e-4;      // of the length of the step
constexpr double feasible_fraction_min = 1e-4; // smaller steps count as blocked

PathPoint between(const PathPoint& from, const PathPoint& to, double t) {
  return {from.q + t * (to.q - from.q), from.load_time + t * (to.load_time - from.load_time)};
}

}  // namespace

PathNewton::PathNewton(const StepperContext& context, const StepObservers& observers)
    : clock_(context.clock), observers_(observers), convergence_(context.world, context.solver, context.time.step),
      steps_(context.world, context.clock, nullptr, context.solver.step_filters()) {
  steps_.observe([this](const VecX& x, const VecX& p, double feasible) {
    if (observers_.steps) observers_.steps(x, p, feasible);
  });
}

// Prescribed vertices may turn: what of a step is feasible is found along straight lines to its end.
PathPoint PathNewton::truncated(const PathEquations& equations, const PathPoint& from, const PathPoint& to) {
  const VecX x = equations.configuration(from);
  for (double t = 1; t > feasible_fraction_min;) {
    PathPoint end = between(from, to, t);
    const double feasible = steps_.largest_requested(x, equations.configuration(end) - x);
    if (feasible >= 1) return end;
    t *= usable_fraction * feasible;
  }
  return from;
}

PathNewton::Result PathNewton::solve(PathEquations& equations, StepPotential& potential, PathConstraint constraint, double length, PathPoint guess) {
  Result result{{MinimizerStatus::iteration_limit}, std::move(guess), 0, {}};
  const auto end = [&](MinimizerStatus status) {
    result.work.status = status;
    return result;
  };
  for (int& i = result.work.iterations; i < max_iterations; ++i) {
    equations.move_to(result.point);
    const BlockMatrix& hessian = potential.hessian({});
    const VecX gradient = potential.gradient();
    const double error = length - equations.value(constraint, result.point);
    if (!gradient.allFinite() || !std::isfinite(error)) return end(MinimizerStatus::not_finite);
    if (!factor_.factorize(hessian, clock_)) return end(MinimizerStatus::factorization_failed);
    result.negative_pivots = factor_.negative_pivots();
    const VecX out_of_balance = factor_.solve(gradient, clock_);
    const double balance = std::max(convergence_.norm(out_of_balance, gradient), convergence_.imbalance(gradient));
    result.work.residual = std::max(balance, std::abs(error) / (length_tolerance * std::abs(length)));
    result.force_residual = convergence_.force_residual();
    if (observers_.minimizer) observers_.minimizer(i, result.work.residual, potential.value(), 0);
    if (result.work.residual <= 1) return end(MinimizerStatus::converged);
    const PathEquations::Derivatives d = equations.derivatives(constraint, result.point);
    const VecX tangent = -factor_.solve(d.gradient_by_time, clock_);  // dq/dt at equilibrium
    result.work.linear_solves += 2;
    const double along = d.constraint_by_time + d.constraint_by_q.dot(tangent);
    const double dt = (error + d.constraint_by_q.dot(out_of_balance)) / along;
    const PathPoint next{result.point.q + dt * tangent - out_of_balance, result.point.load_time + dt};
    if (!std::isfinite(dt) || !next.q.allFinite()) return end(MinimizerStatus::not_finite);
    PathPoint feasible = truncated(equations, result.point, next);
    if (feasible.load_time == result.point.load_time && feasible.q == result.point.q) return end(MinimizerStatus::blocked);
    result.point = std::move(feasible);
  }
  return result;
}

PathPoint PathNewton::along_tangent(PathEquations& equations, StepPotential& potential, PathConstraint constraint, double length) {
  const PathPoint& start = equations.start();
  equations.move_to(start);
  if (!factor_.factorize(potential.hessian({}), clock_)) return start;
  const PathEquations::Derivatives d = equations.derivatives(PathConstraint::load_time, start);
  const VecX tangent = -factor_.solve(d.gradient_by_time, clock_);
  const PathPoint unit{start.q + tangent, start.load_time + 1};
  equations.move_to(start);
  const double unit_length = equations.value(constraint, unit);
  if (!(unit_length > 0) || !std::isfinite(unit_length)) return start;
  return truncated(equations, start, between(start, unit, length / unit_length));
}

}  // namespace tack
