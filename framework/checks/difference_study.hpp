// Whether derivatives are those of what they claim to differentiate, judged by how central differences
// converge to them as the step shrinks. With steps s_k = s_0 / 4^k the error e_k of the quotient is C s_k^2 (the
// differences' own, which E_k = (16 e_{k+1} - e_k) / 15 is rid of) plus rounding / s_k plus what the derivative is
// wrong by. Of the four consecutive E_k that are least, the mean is the error and the spread what the differences
// can resolve: a wrong derivative is off by the same at all of them.
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct DifferenceStudy {
  static constexpr int steps = 12;
  static constexpr double first_step = 0.05, ratio = 4;  // the last: 1e-8

  double scale = 0;       // the largest of the quantity itself, in its own unit; 0: identically zero
  double error = 0;       // of the worst component that can be judged, relative to its scale
  double resolution = 0;  // what differences can tell, relative: the 95th percentile over components
  int components = 0, unclear = 0;  // those at a kink, or drowned in rounding, cannot be judged
  bool wrong = false;     // some component is off by far more than differences leave open

  void merge(const DifferenceStudy& other);  // the worse of both
};

// errors[k]: quotient - derivative, per component, at step k; scales: per component, of the derivative's parts
// before they cancel (a sum of absolute values); at least the derivative itself. `tolerance`: relative.
DifferenceStudy study_differences(const std::vector<VecX>& errors, const VecX& scales, double tolerance);

}  // namespace tack
