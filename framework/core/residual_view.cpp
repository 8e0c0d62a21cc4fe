#include "framework/core/residual_view.hpp"

#include <fmt/format.h>

#include "framework/core/objective.hpp"
#include "framework/core/term.hpp"
#include "geometry/errors.hpp"

namespace tack {

std::vector<const ResidualView*> residual_views(const std::vector<const Term*>& terms, const std::string& who) {
  std::vector<const ResidualView*> views;
  for (const Term* term : terms) {
    views.push_back(term->residual_view());
    if (!views.back())
      throw InputError(fmt::format("{} minimises sums of squares, and '{}' with these parameters is none; use "
                                   "another solver.type (projected_newton)", who, term->name()));
  }
  return views;
}

LeastSquares Objective::least_squares() const {
  throw InputError("this objective is no sum of squares; use another solver.type (projected_newton)");
}

double Objective::part_value(int) { throw InputError("this objective is not divided into parts"); }
VecX Objective::part_gradient(int) { throw InputError("this objective is not divided into parts"); }

std::unique_ptr<Objective> Objective::restricted(std::span<const int>) {
  throw InputError("this objective has no local problems; use another solver.step");
}

}  // namespace tack
