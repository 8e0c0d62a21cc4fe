// Backtracking with the Armijo condition E(q + t p) <= E(q) + c t p.g. Where the decrease is below
// the rounding error of E, close to a minimum, the slope decides instead, by the approximate Wolfe
// condition of Hager and Zhang 2005, (2 c - 1) p.g >= p.g(q + t p), which rounding affects little.
// Hence the search does not stall on round-off.
#include <algorithm>
#include <cmath>

#include "framework/config/field.hpp"
#include "solvers/line_search/line_search.hpp"

namespace tack {

class Backtracking : public LineSearch {
 public:
  void fields(Fields& f) override {
    f.number("decrease", decrease_, units::none, "c of the Armijo condition").range(0, 0.5);
    f.number("shrink", shrink_, units::none, "factor between trial steps").range(0.05, 0.95);
    f.integer("max_trials", max_trials_, "trial steps before giving up").at_least(1);
  }

  LineSearchResult search(Objective& objective, const VecX& q, const VecX& p, double slope,
                          double t_max) override {
    LineSearchResult result;
    const double start = objective.value();
    const double start_noise = objective.value_noise();
    const double t_min = std::min(t_max, smallest_step(q, p));
    double t = t_max;
    for (int trial = 0; trial < max_trials_ && t >= t_min; ++trial, t *= shrink_) {
      objective.move_to(q + t * p);
      const double value = objective.value();
      ++result.evaluations;
      if (!std::isfinite(value)) continue;
      const double noise = std::max(start_noise, objective.value_noise());
      const bool in_the_noise = std::abs(value - start) <= noise;
      if (descends(start, value, noise, t, slope, decrease_) || (in_the_noise && flat_enough(objective, p, slope))) {
        result.found = true;
        result.step = t;
        return result;
      }
    }
    return result;
  }

 private:
  bool flat_enough(Objective& objective, const VecX& p, double slope) const {
    return objective.gradient().dot(p) <= (2 * decrease_ - 1) * slope;
  }

  double decrease_ = 1e-4;
  double shrink_ = 0.5;
  int max_trials_ = 60;
};

TACK_REGISTER(LineSearch, Backtracking, "backtracking",
              "Armijo backtracking; uses the slope if energy differences are below round-off.",
              "Nocedal and Wright, Numerical Optimization, 3.1; Hager and Zhang 2005");

}  // namespace tack
