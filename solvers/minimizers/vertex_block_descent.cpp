// Vertex block descent: coordinate descent over vertices. A sweep visits colours of units of motion
// (the three unknowns of a vertex, the twelve of an affine body), no two of a colour in a common
// stencil, so that those of a colour move at once. Each makes its own Newton step with the others
// at rest, from its diagonal block of the projected Hessian: H_uu p_u = -g_u. Values, derivatives
// and bounds of a colour are those of its stencils alone (MinimizerProblem::locals).
//
// Feasibility: pairs that are close may be new since units were coloured, so that bounds of units
// that move alone would not do. Each unit has the bound that holds whatever the others of its colour
// do (BlockBound::together), which for a pair with one moving unit is that of collision detection.
// Descent: the sum over a colour has to fall by Armijo's condition; units that end beyond their own
// minimum halve their steps until it does. So a colouring that is out of date costs time, and neither
// feasibility nor descent.
//
// Acceleration (Chebyshev): after sweep n, q <- w_n (q - q_{n-2}) + q_{n-2}, w_1 = 1, w_2 = 2 / (2 -
// r^2), w_{n+1} = 4 / (4 - r^2 w_n), as far as it is feasible and if it decreases the objective.
#include <Eigen/Cholesky>
#include <algorithm>

#include "framework/config/field.hpp"
#include "framework/core/deadline.hpp"
#include "geometry/interrupt.hpp"
#include "geometry/parallel.hpp"
#include "solvers/line_search/line_search.hpp"
#include "solvers/minimizers/convergence_judge.hpp"
#include "solvers/minimizers/iteration_notifier.hpp"
#include "solvers/minimizers/local_problems.hpp"
#include "solvers/minimizers/unit_colors.hpp"

namespace tack {

class VertexBlockDescent : public Minimizer {
 public:
  VertexBlockDescent() { max_iterations_ = 20000; }
  void fields(Fields& f) override {
    Minimizer::fields(f);
    f.number("chebyshev_radius", radius_, units::none, "spectral radius of the sweeps for Chebyshev's acceleration; 0: none").range(0, 0.9999);
  }

  MinimizerResult minimize(const MinimizerProblem& problem, VecX& q) override {
    MinimizerResult result;
    try {
      result.status = descend(problem, q, result);
    } catch (const OutOfTime&) {
      result.status = MinimizerStatus::time_limit;
    }
    return result;
  }

 private:
  MinimizerStatus descend(const MinimizerProblem& problem, VecX& q, MinimizerResult& result) {
    Objective& objective = problem.objective;
    objective.move_to(q);
    judge_.begin();
    const IterationNotifier notify(problem);
    UnitColors colors(problem, objective.hessian({Projection::clamp}));
    const std::vector<LocalProblem> parts = local_problems(problem, colors.sets, q);
    objective.move_to(q);
    VecX last, before_last;
    for (double weight = 1; result.iterations < max_iterations_; notify(result)) {
      if (interrupt_requested) return MinimizerStatus::interrupted;
      if (!objective.gradient().allFinite()) return MinimizerStatus::not_finite;
      if (judge_.converged(problem, result)) return MinimizerStatus::converged;
      before_last = std::exchange(last, q);
      MinimizerStatus swept = MinimizerStatus::blocked;
      for (size_t c = 0; c < parts.size(); ++c) {
        const MinimizerStatus relaxed = relax(problem, parts[c], colors, c, q, result);
        if (relaxed == MinimizerStatus::factorization_failed) return relaxed;
        if (swept != MinimizerStatus::converged && relaxed != MinimizerStatus::blocked) swept = relaxed;
      }
      objective.move_to(q);
      if (swept != MinimizerStatus::converged) return swept;
      ++result.iterations;
      weight = accelerate(problem, before_last, weight, q, result);
    }
    return MinimizerStatus::iteration_limit;
  }

  // Moves the units of a colour. Returns `converged` if any moved, `blocked` if none may.
  MinimizerStatus relax(const MinimizerProblem& problem, const LocalProblem& part, const UnitColors& colors, size_t c, VecX& q, MinimizerResult& result) {
    constexpr double sufficient = 1e-4, shortest = 1e-12;
    constexpr int most_trials = 30;
    const VecX start = part.resume();
    Objective& local = *part.objective;
    VecX p = colors.newton_steps(c, local.hessian({Projection::clamp}), local.gradient());
    if (!p.allFinite()) return MinimizerStatus::factorization_failed;
    const VecX gradient = local.gradient(), bounds = part.block_bounds(start, p);
    if (!(bounds.maxCoeff() > shortest)) return MinimizerStatus::blocked;
    for (Eigen::Index b = 0; b < bounds.size(); ++b) p.segment<3>(3 * b) *= bounds(b);
    const PhaseScope scope(problem.clock, Phase::line_search);
    const double before = local.value(), noise = local.value_noise();
    for (int trial = 0; trial < most_trials; ++trial) {
      const double slope = gradient.dot(p);
      if (!(slope < 0)) break;
      local.move_to(start + p);
      ++result.line_search_evaluations;
      const double value = local.value(), larger_noise = std::max(noise, local.value_noise());
      const bool flat = std::abs(value - before) <= larger_noise;
      if (descends(before, value, larger_noise, 1, slope, sufficient) || (flat && local.gradient().dot(p) <= (2 * sufficient - 1) * slope)) {
        colors.scatter(c, start + p, q);
        return MinimizerStatus::converged;
      }
      colors.halve_overshooting(c, local.gradient(), p);
    }
    local.move_to(start);
    return MinimizerStatus::line_search_failed;
  }

  // Extrapolates q, where the objective is, from q two sweeps ago. Returns the weight of the next
  // sweep.
  double accelerate(const MinimizerProblem& problem, const VecX& before_last, double weight, VecX& q, MinimizerResult& result) const {
    if (radius_ == 0 || before_last.size() == 0) return 1;
    const double next = weight == 1 ? 2 / (2 - radius_ * radius_) : 4 / (4 - radius_ * radius_ * weight);
    const VecX p = (next - 1) * (q - before_last);
    const double value = problem.objective.value(), t = problem.feasible_step(q, p);
    problem.objective.move_to(q + t * p);
    ++result.line_search_evaluations;
    if (problem.objective.value() < value) {
      q += t * p;
      return t < 1 ? 1 : next;
    }
    problem.objective.move_to(q);
    return 1;
  }

  double radius_ = 0.95;
  ConvergenceJudge judge_;
};

TACK_REGISTER(Minimizer, VertexBlockDescent, "vertex_block_descent",
              "Coordinate descent over vertices in coloured sweeps, each with a Newton step of its own.",
              "Chen, Liu, Yang, Yuksel 2024, Vertex Block Descent; Wang 2015 (Chebyshev acceleration)");

}  // namespace tack
