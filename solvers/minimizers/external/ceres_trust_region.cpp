// Ceres' trust-region methods on the least-squares view of the potential. In each round Ceres runs
// a few iterations on the model of residual_model.hpp; the displacement to its result is the search
// direction p of the descent loop, bounded by the step filters and searched on the true potential.
// The potential falls along p, at least after a single Ceres iteration; after a direction that
// fails, rounds get shorter. If Ceres finds no decrease, p leads to its first trial: near the
// minimum the decrease falls below the rounding error of a sum of squares sooner than below that of
// the potential.
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <deque>

#include "framework/config/field.hpp"
#include "framework/core/term.hpp"
#include "solvers/linear/dense_kernels.hpp"
#include "solvers/minimizers/external/ceres_common.hpp"
#include "solvers/minimizers/external/ceres_residuals.hpp"
#include "solvers/minimizers/descent_minimizer.hpp"

namespace tack {

class CeresTrustRegion : public DescentMinimizer {
 public:
  enum class Strategy { levenberg_marquardt, dogleg, subspace_dogleg };

  void fields(Fields& f) override {
    DescentMinimizer::fields(f);
    f.choice("strategy", strategy_,
             {{"levenberg_marquardt", Strategy::levenberg_marquardt, "damped Gauss-Newton steps"},
              {"dogleg", Strategy::dogleg, "Powell's path from the steepest descent to the Gauss-Newton step"},
              {"subspace_dogleg", Strategy::subspace_dogleg, "the best step of the plane that both span"}},
             "choice of the step in the trust region");
    f.integer("inner_iterations", inner_iterations_, "steps of Ceres between two updates of contacts and potential")
        .at_least(1);
  }

  void admit(const std::vector<const Term*>& terms, int) const override {
    residual_views(terms, std::string(type()));
  }

 protected:
  void begin(const MinimizerProblem&, MinimizerResult&) override {
    radius_ = first_radius;
    inner_ = inner_iterations_;
  }

  MinimizerStatus direction(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) override {
    ResidualModel model(problem.objective);
    const VecX start = model.q();
    propose(model, problem.clock, result);
    p = model.q() - start;
    return p.allFinite() ? MinimizerStatus::converged : MinimizerStatus::factorization_failed;
  }

  void stepped(const MinimizerProblem&, const Step& step) override {
    if (step.length < 0.5) radius_ *= std::max(step.length, 0.1);
    inner_ = std::min(2 * inner_, inner_iterations_);
  }

  bool restart(const MinimizerProblem&) override {
    if (inner_ == 1) return false;
    inner_ /= 2;
    return true;
  }

 private:
  static constexpr double first_radius = 1e4;                            // Ceres' default
  // Bounds of the radius of a new round.
  static constexpr double smallest_radius = 1e-6, largest_radius = 1e12;
  static constexpr int failures = 5;  // steps that do not improve the model, per round
  static constexpr double cost_noise = 1e-11;  // relative rounding error of a sum of squares

  // Moves the model's unknowns by one round of Ceres.
  void propose(ResidualModel& model, PhaseClock& clock, MinimizerResult& result) {
    const PhaseScope scope(clock, Phase::solve);
    blas::set_threads(1);  // the same bits with any number of threads, as num_threads below
    EvaluateModel evaluate(model, clock);
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;
    options.evaluation_callback = &evaluate;
    std::deque<StencilCost> stencils;  // a deque neither copies nor moves its entries
    std::deque<InertiaCost> inertia;
    ceres::Problem problem(options);
    const auto unknowns = [&](int b) { return model.q().data() + 3 * static_cast<size_t>(b); };
    for (int b = 0; b < model.dofs().block_count(); ++b)
      problem.AddResidualBlock(&inertia.emplace_back(model, b), nullptr, unknowns(b));
    for (const ResidualModel::Stencil& s : model.stencils()) {
      std::vector<double*> blocks;
      for (int k = 0; k < s.blocks; ++k) blocks.push_back(unknowns(model.blocks(s)[k]));
      if (!blocks.empty())
        problem.AddResidualBlock(&stencils.emplace_back(model, s, evaluate.finite), nullptr, blocks);
    }
    StopAfter stop(inner_);
    ceres::Solver::Summary summary;
    ceres::Solve(solver_options(stop), &problem, &summary);
    if (summary.initial_cost - summary.final_cost > cost_noise * summary.initial_cost) {
      radius_ = std::clamp(stop.radius, smallest_radius, largest_radius);
    } else if (evaluate.first_trial.size() > 0) {
      model.q() = evaluate.first_trial;
    }
    result.linear_solves += std::max(summary.num_linear_solves, 0);
    result.line_search_evaluations += std::max(summary.num_residual_evaluations, 0);
  }

  ceres::Solver::Options solver_options(StopAfter& stop) const {
    ceres::Solver::Options o;
    o.minimizer_type = ceres::TRUST_REGION;
    o.trust_region_strategy_type =
        strategy_ == Strategy::levenberg_marquardt ? ceres::LEVENBERG_MARQUARDT : ceres::DOGLEG;
    o.dogleg_type = strategy_ == Strategy::subspace_dogleg ? ceres::SUBSPACE_DOGLEG : ceres::TRADITIONAL_DOGLEG;
    o.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    o.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
    o.initial_trust_region_radius = radius_;
    o.max_trust_region_radius = 1e16;
    o.max_num_iterations = inner_ + failures;
    o.max_num_consecutive_invalid_steps = failures;
    // The judge decides on convergence, not Ceres.
    o.function_tolerance = o.gradient_tolerance = o.parameter_tolerance = 0;
    o.num_threads = 1;
    o.callbacks.push_back(&stop);
    silence(o);
    return o;
  }

  Strategy strategy_ = Strategy::levenberg_marquardt;
  int inner_iterations_ = 2;
  int inner_ = 2;           // of the next round
  double radius_ = first_radius;
};

TACK_REGISTER(Minimizer, CeresTrustRegion, "ceres_trust_region",
              "Trust-region least squares of Ceres Solver. Refuses terms that are no sums of squares (solids with a "
              "negative Poisson's ratio); negative weights of contact in concave regions are linearised in each "
              "round.",
              "Agarwal, Mierle and others, Ceres Solver 2.1");

}  // namespace tack
