#include "solvers/minimizers/guarded_problem.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/deadline.hpp"
#include "geometry/interrupt.hpp"

namespace tack {
namespace {

constexpr int patience = 50;  // consecutive trials that are blocked, or at the last accepted point
constexpr int trials_per_iteration = 20;  // on average, before the iteration budget is used up

VecX diagonal_of(const BlockMatrix& matrix) {
  VecX diagonal(matrix.size());
  for (int c = 0; c < matrix.columns(); ++c)
    diagonal.segment<3>(3 * c) = matrix.block(matrix.column_start[c]).diagonal();
  for (const GlobalMode& mode : matrix.modes) diagonal += mode.coefficient * mode.vector.cwiseAbs2();
  return diagonal;
}

// Returns the longest side of the bounding box of all points.
double extent(const VecX& q) {
  double side = 0;
  for (int c = 0; c < 3; ++c) {
    const Eigen::Map<const VecX, 0, Eigen::InnerStride<3>> along(q.data() + c, q.size() / 3);
    side = std::max(side, along.maxCoeff() - along.minCoeff());
  }
  return side;
}

}  // namespace

GuardedProblem::GuardedProblem(const MinimizerProblem& problem, ConvergenceJudge& judge, int max_iterations,
                               VecX& q, MinimizerResult& result)
    : problem_(problem), judge_(judge), notify_(problem), max_iterations_(max_iterations), q_(q), result_(result),
      trials_left_(trials_per_iteration * max_iterations) {
  problem.objective.move_to(q);
  judge_.begin();
}

bool GuardedProblem::begin_round() {
  Objective& objective = problem_.objective;
  objective.move_to(q_);
  accepted_gradient_ = objective.gradient();
  accepted_value_ = objective.value();
  accepted_noise_ = objective.value_noise();
  if (!std::isfinite(accepted_value_) || !accepted_gradient_.allFinite()) stop(MinimizerStatus::not_finite);
  if (!over()) test_accepted_point();
  if (over()) return false;
  VecX diagonal = diagonal_of(objective.hessian({Projection::clamp}));
  const double floor = 1e-12 * diagonal.maxCoeff();
  diagonal = diagonal.cwiseMax(floor > 0 ? floor : 1);
  const VecX root = diagonal.cwiseSqrt().cwiseInverse();
  const double rho = root.cwiseProduct(accepted_gradient_).lpNorm<Eigen::Infinity>();
  rho_squared_ = rho > 0 ? rho * rho : 1;
  scale_ = std::sqrt(rho_squared_) * root;
  centre_ = q_;
  accepted_f_ = 0;
  // Trials much further than the extent of all bodies are errors of the method, and searching them
  // is slow.
  longest_ = std::max(extent(q_), 1e3 * scale_.lpNorm<Eigen::Infinity>());
  iterations_before_ = result_.iterations;
  blocked_ = tried_ = idle_ = 0;
  trial_usable_ = false;
  return true;
}

VecX GuardedProblem::unscaled(const double* z) const {
  return centre_ + scale_.cwiseProduct(Eigen::Map<const VecX>(z, q_.size()));
}

double GuardedProblem::relative_value(const VecX& q, double value, const VecX& gradient) const {
  double difference = value - accepted_value_;
  if (std::abs(difference) <= std::max(accepted_noise_, problem_.objective.value_noise()))
    difference = 0.5 * (gradient + accepted_gradient_).dot(q - q_);
  return accepted_f_ + difference / rho_squared_;
}

GuardedProblem::Trial GuardedProblem::evaluate(const double* z, double& f, double* gradient) {
  trial_usable_ = false;
  feasible_fraction_ = 0;
  ++result_.line_search_evaluations;
  if (interrupt_requested && !over()) stop(MinimizerStatus::interrupted);
  if (--trials_left_ < 0 && !over()) stop(MinimizerStatus::iteration_limit);
  trial_ = unscaled(z);
  if (!trial_.allFinite()) return Trial::not_finite;
  const bool moved = trial_ != q_;
  tried_ += moved;
  VecX p = trial_ - q_;
  const double largest = p.lpNorm<Eigen::Infinity>();
  const double fraction = largest > longest_ ? longest_ / largest : 1;
  p *= fraction;
  feasible_fraction_ = moved ? fraction * problem_.feasible_step(q_, p) : 1;
  if (feasible_fraction_ < 1) {
    ++blocked_;
    ++idle_;
    return Trial::blocked;
  }
  idle_ = moved ? 0 : idle_ + 1;
  const PhaseScope scope(problem_.clock, Phase::line_search);
  Objective& objective = problem_.objective;
  objective.move_to(trial_);
  const double value = objective.value();
  const VecX& slope = objective.gradient();
  if (!std::isfinite(value) || !slope.allFinite()) return Trial::not_finite;
  f = trial_f_ = relative_value(trial_, value, slope);
  if (gradient) Eigen::Map<VecX>(gradient, q_.size()) = scale_.cwiseProduct(slope) / rho_squared_;
  trial_usable_ = true;
  return Trial::usable;
}

void GuardedProblem::evaluate_penalty(const double* z, double& f, double* gradient) {
  const VecX offset = (Eigen::Map<const VecX>(z, q_.size()) - (q_ - centre_).cwiseQuotient(scale_)).eval();
  const double length_squared = offset.squaredNorm();
  if (!std::isfinite(length_squared)) {
    f = 1e10;
    if (gradient) Eigen::Map<VecX>(gradient, q_.size()).setZero();
    return;
  }
  // The tangent at the last accepted point plus a parabola whose minimum is half way to the blocked
  // position, so that interpolating methods try there next.
  const VecX tangent = scale_.cwiseProduct(accepted_gradient_) / rho_squared_;
  const double pull = std::max(0.0, -tangent.dot(offset));
  const double steepness = 1 + pull / std::clamp(feasible_fraction_, 1e-6, 0.5) / std::max(length_squared, 1e-300);
  f = accepted_f_ + tangent.dot(offset) + steepness * length_squared;
  if (gradient) Eigen::Map<VecX>(gradient, q_.size()) = tangent + 2 * steepness * offset;
}

bool GuardedProblem::accept(const double* z) {
  if (over()) return false;
  if (!trial_usable_ || unscaled(z) != trial_) {
    double f = 0;
    if (evaluate(z, f, nullptr) != Trial::usable) return false;
  }
  if (!(trial_f_ < accepted_f_)) return false;
  Objective& objective = problem_.objective;
  q_ = trial_;
  accepted_f_ = trial_f_;
  accepted_value_ = objective.value();
  accepted_noise_ = objective.value_noise();
  accepted_gradient_ = objective.gradient();
  trial_usable_ = false;
  ++result_.iterations;
  test_accepted_point();
  notify_(result_);
  return true;
}

void GuardedProblem::test_accepted_point() {
  if (over()) return;
  if (interrupt_requested) return stop(MinimizerStatus::interrupted);
  if (judge_.converged(problem_, result_)) return stop(MinimizerStatus::converged);
  if (result_.iterations >= max_iterations_) stop(MinimizerStatus::iteration_limit);
}

bool GuardedProblem::makes_no_progress() const { return idle_ >= patience; }

MinimizerStatus GuardedProblem::reason() const {
  return tried_ > 0 && blocked_ == tried_ ? MinimizerStatus::blocked : MinimizerStatus::line_search_failed;
}

namespace {

MinimizerStatus guarded_rounds(const MinimizerProblem& problem, ConvergenceJudge& judge, int max_iterations,
                               VecX& q, MinimizerResult& result,
                               const std::function<void(GuardedProblem&)>& round) {
  GuardedProblem guarded(problem, judge, max_iterations, q, result);
  for (int fruitless = 0; guarded.begin_round();) {
    {
      const PhaseScope scope(problem.clock, Phase::solve);
      round(guarded);
    }
    guarded.rethrow();
    fruitless = guarded.fruitless() ? fruitless + 1 : 0;
    if (fruitless == 2 && !guarded.over()) guarded.stop(guarded.reason());
  }
  return guarded.status();
}

}  // namespace

MinimizerResult minimize_in_rounds(const MinimizerProblem& problem, ConvergenceJudge& judge, int max_iterations,
                                   VecX& q, const std::function<void(GuardedProblem&)>& round) {
  MinimizerResult result;
  try {
    result.status = guarded_rounds(problem, judge, max_iterations, q, result, round);
  } catch (const OutOfTime&) {
    result.status = MinimizerStatus::time_limit;
  }
  return result;
}

}  // namespace tack
