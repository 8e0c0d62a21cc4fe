// Parameter-free backtracking that does not stall near a minimum. A step is accepted if
//     the energy falls by more than its rounding error, or
//     the change of the energy is within the rounding error and |p.g(q + t p)| <= |p.g|.
// Armijo's condition asks for a decrease that stiff problems cannot show in floating point.
#include <algorithm>
#include <cmath>

#include "framework/config/field.hpp"
#include "solvers/line_search/line_search.hpp"

namespace tack {

class Robust : public LineSearch {
 public:
  LineSearchResult search(Objective& objective, const VecX& q, const VecX& p, double slope,
                          double t_max) override {
    constexpr int max_trials = 60;
    LineSearchResult result;
    const double start = objective.value(), start_noise = objective.value_noise();
    const double t_min = std::min(t_max, smallest_step(q, p));
    for (double t = t_max; result.evaluations < max_trials && t >= t_min; t /= 2) {
      objective.move_to(q + t * p);
      ++result.evaluations;
      const double value = objective.value();
      if (!std::isfinite(value)) continue;
      const double noise = std::max(start_noise, objective.value_noise());
      const bool lower = value < start - noise;
      const bool as_low = value <= start + noise && std::abs(objective.gradient().dot(p)) <= std::abs(slope);
      if (!lower && !as_low) continue;
      result.found = true;
      result.step = t;
      break;
    }
    return result;
  }
};

TACK_REGISTER(LineSearch, Robust, "robust",
              "Parameter-free backtracking: accepts any decrease of the energy or, below round-off, a slope that does not grow.",
              "after Longva et al. 2023, Pitfalls of Projection");

}  // namespace tack
