// Relative residual to which an inexact Newton method solves its next system: the second choice of
// Eisenstat and Walker (1996),
//   eta_k = gamma (|g_k| / |g_k-1|)^2, not below gamma eta_k-1^2 while that is above 0.1,
// so that convergence stays superlinear and the first steps, far from the minimum, cost little.
#pragma once

#include <algorithm>

#include "framework/config/field.hpp"

namespace tack {

class ForcingTerm {
 public:
  void fields(Fields& f) {
    f.number("forcing_max", largest_, units::none, "largest relative residual of a system")
        .range(1e-6, 0.5);
    f.number("forcing_min", smallest_, units::none,
             "smallest relative residual of a system, except the last, which is solved as "
             "accurately as the convergence test needs")
        .range(1e-12, 0.1);
    f.check("forcing_min",
            [this] { return smallest_ <= largest_ ? "" : "forcing_min is above forcing_max"; });
  }
  void begin() { last_gradient_ = 0; }
  // Returns the relative residual of the next system. gradient: |g|.
  double next(double gradient) {
    constexpr double gamma = 0.9, safeguard = 0.1;
    double forcing = largest_;
    if (last_gradient_ > 0) {
      const double ratio = gradient / last_gradient_, before = gamma * forcing_ * forcing_;
      forcing = gamma * ratio * ratio;
      if (before > safeguard) forcing = std::max(forcing, before);
    }
    last_gradient_ = gradient;
    return forcing_ = std::clamp(forcing, smallest_, largest_);
  }

 private:
  double largest_ = 0.1, smallest_ = 1e-3;
  double forcing_ = 0;        // of the last system
  double last_gradient_ = 0;  // |g| of the last system; 0: none
};

}  // namespace tack
