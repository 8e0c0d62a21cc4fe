// Measured values without their noise.
#pragma once

#include <vector>

namespace tack {

// Returns locally weighted linear regression of the values within `reach` of each x (tricube
// weights; LOWESS of fixed width, Cleveland 1979): straight lines stay, oscillations shorter than
// `reach` vanish, narrower peaks get lower. x ascends, reach > 0.
std::vector<double> smoothed(const std::vector<double>& x, const std::vector<double>& values,
                             double reach);

// How often values turn from rising to falling or back, by more than `least`.
int turns(const std::vector<double>& values, double least);

}  // namespace tack
