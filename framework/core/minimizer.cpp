#include "framework/core/minimizer.hpp"

#include "framework/config/field.hpp"

namespace tack {

void Minimizer::fields(Fields& f) {
  f.number("tolerance", tolerance_, units::velocity,
           "stops when |p|_inf / h is below, p the last search direction").positive();
  f.number("force_tolerance", force_tolerance_, units::none,
           "quasi-static: stops when the largest residual force is below this part of the largest "
           "force of any element or contact").positive();
  f.integer("max_iterations", max_iterations_, "iterations before the step is given up").at_least(1);
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
  }
  return "unknown";
}

}  // namespace tack
