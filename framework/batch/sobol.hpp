// Points that fill the unit cube evenly (Sobol 1967; Joe and Kuo 2008), without the first one, the origin: the centre comes first. More points
// keep those that are there.
#pragma once

#include <vector>

namespace tack {

// count x dimensions, row after row, in (0, 1).
std::vector<double> sobol_points(int count, int dimensions);

}  // namespace tack
