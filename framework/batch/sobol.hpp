// Sobol points, which fill the unit cube evenly (Sobol 1967; Joe and Kuo 2008), without the origin:
// the first point is the centre. A longer sequence begins with the shorter one.
#pragma once

#include <vector>

namespace tack {

// Returns count x dimensions coordinates in (0, 1), row by row.
std::vector<double> sobol_points(int count, int dimensions);

}  // namespace tack
