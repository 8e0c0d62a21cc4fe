// Measured values without their noise.
#pragma once

#include <vector>

namespace tack {

// At each x the line that fits the values within `reach` of it best, nearer ones counting more (tricube weights; Cleveland 1979, LOWESS, of a
// fixed width): straight lines stay, what wiggles within less than the reach goes, peaks narrower than that get lower. x ascends, reach > 0.
std::vector<double> smoothed(const std::vector<double>& x, const std::vector<double>& values, double reach);

// How often values turn from rising to falling or back, by more than `least`.
int turns(const std::vector<double>& values, double least);

}  // namespace tack
