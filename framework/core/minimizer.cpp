#include "framework/core/minimizer.hpp"

#include <algorithm>

#include "framework/config/bind.hpp"
#include "framework/config/field.hpp"

namespace tack {

void Minimizer::fields(Fields& f) {
  f.choice("stopping", stopping_,
           {{"velocity", Stopping::velocity, "|p|_inf / h against `tolerance`, p the Newton direction"},
            {"force", Stopping::force, "largest residual force against `force_tolerance`; quasi-static steps always"},
            {"acceleration", Stopping::acceleration, "largest M^-1 times residual force against `acceleration_tolerance`"}},
           "convergence criterion");
  f.optional_number("tolerance", tolerance_, units::velocity,
                    "tolerance of the velocity. Unless given 1 cm/s, or less: a step errs by at most a tenth of the "
                    "contact distance and a thousandth of the smallest moving object, and the tolerance stays below "
                    "the speed at which friction sticks (eps_v, down to 0.1 mm/s)").positive();
  f.number("force_tolerance", force_tolerance_, units::none,
           "residual force at a degree of freedom, relative to the largest force of the elements and contacts of its body").positive();
  f.optional_number("balance_tolerance", balance_tolerance_, units::none,
                    "force residual relative to the reference force: the largest force of inertia, loads or elements "
                    "of the bodies in contact. It must hold too if `stopping` is velocity or acceleration. Unless "
                    "given 0.01, and steps that stagnate may end above it (unbalanced_steps in summary.json)").positive();
  f.optional_number("force_floor", force_floor_, units::force,
                    "force residual that is always accepted, as is the round-off of the elements around a vertex; "
                    "unless given, the force that changes the velocity of the heaviest vertex of the bodies in "
                    "contact by `tolerance` in a step").nonnegative();
  f.number("acceleration_tolerance", acceleration_tolerance_, units::acceleration,
           "tolerance of the residual acceleration").positive();
  f.integer("max_iterations", max_iterations_, "iterations after which the solve fails").at_least(1);
  f.optional_number("time_limit", time_limit_, units::time,
                    "wall time of one solve, after which it fails and the step is divided into substeps; none unless given")
      .positive();
  f.component_list("step_filters", step_filters_,
                   "bounds of every step, so that nothing intersects or inverts on its way; states at the end of steps are checked exactly in any case");
  f.flag("check_iterates", check_iterates_,
         "check every iterate exactly for intersections and inverted tets, and end the run at the first one; slow");
}

std::unique_ptr<Minimizer> Minimizer::fresh() const { return instance_of(*this); }

bool balanced(const MinimizerProblem& problem, MinimizerResult& result) {
  if (!problem.force_residual) return true;
  const double residual = problem.force_residual(problem.objective.gradient());
  if (residual <= 1) return true;
  result.residual = std::max(result.residual, residual);
  return false;
}

std::string_view to_string(MinimizerStatus status) {
  switch (status) {
    case MinimizerStatus::converged: return "converged";
    case MinimizerStatus::iteration_limit: return "iteration limit reached";
    case MinimizerStatus::line_search_failed: return "line search failed";
    case MinimizerStatus::blocked: return "blocked by contact or inversion";
    case MinimizerStatus::factorization_failed: return "factorization failed";
    case MinimizerStatus::not_finite: return "value or gradient is not finite";
    case MinimizerStatus::interrupted: return "interrupted";
    case MinimizerStatus::time_limit: return "out of wall time";
  }
  return "unknown";
}

}  // namespace tack
