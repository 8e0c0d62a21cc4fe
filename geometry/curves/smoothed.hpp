// Smoothing of measured values.
#pragma once

#include <vector>

namespace tack {

// Returns the locally weighted linear regression of the values within `half_width` of each x
// (tricube weights; LOWESS of fixed width, Cleveland 1979). Straight lines stay, oscillations
// shorter than `half_width` vanish, narrower peaks get lower. x ascends, half_width > 0.
std::vector<double> smoothed(const std::vector<double>& x, const std::vector<double>& values,
                             double half_width);

// Returns how often values change between rising and falling by more than `least`.
int count_reversals(const std::vector<double>& values, double least);

}  // namespace tack
