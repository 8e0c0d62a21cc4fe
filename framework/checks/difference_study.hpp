// Difference study: judges derivatives by the convergence of central differences as the step
// shrinks. With steps s_k = s_0 / 4^k the error of the quotient is
//     e_k = C s_k^2 + rounding / s_k + error of the derivative,
// and E_k = (16 e_{k+1} - e_k) / 15 is free of the first term. Of the four consecutive smallest
// E_k, the mean is the error of the derivative, and the spread the resolution of the differences: a
// wrong derivative has the same error in all of them.
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct DifferenceStudy {
  static constexpr int steps = 12;
  static constexpr double first_step = 0.05, ratio = 4;  // the last: 1e-8

  double scale = 0;       // largest value of the quantity, in its own unit; 0: all zero
  double error = 0;       // of the worst component that can be judged, relative to its scale
  double resolution = 0;  // relative resolution: the 95th percentile over components
  int components = 0, unclear = 0;  // those at a kink, or drowned in rounding, cannot be judged
  bool wrong = false;               // some component is off by far more than differences leave open

  void merge(const DifferenceStudy& other);  // the worse of both
};

// errors[k]: quotient less derivative, per component, at step k; scales: per component, the sum of
// absolute values of the parts of the derivative before they cancel; tolerance: relative;
// round_off: of the derivative itself, per component, which no difference shows; empty: none.
DifferenceStudy study_differences(const std::vector<VecX>& errors, const VecX& scales,
                                  double tolerance, const VecX& round_off = {});

}  // namespace tack
