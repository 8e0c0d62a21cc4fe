#include "geometry/curves/smoothed.hpp"

#include <algorithm>
#include <cmath>

namespace tack {

std::vector<double> smoothed(const std::vector<double>& x, const std::vector<double>& values, double reach) {
  std::vector<double> result(x.size());
  size_t begin = 0, end = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    while (x[begin] <= x[i] - reach) ++begin;
    while (end < x.size() && x[end] < x[i] + reach) ++end;
    double w = 0, wx = 0, wxx = 0, wy = 0, wxy = 0;  // sums, x counted from here in reaches
    for (size_t j = begin; j < end; ++j) {
      const double u = (x[j] - x[i]) / reach, v = 1 - std::abs(u * u * u), weight = v * v * v;
      w += weight, wx += weight * u, wxx += weight * u * u, wy += weight * values[j], wxy += weight * u * values[j];
    }
    const double determinant = w * wxx - wx * wx;
    result[i] = determinant > 1e-12 * w * wxx ? (wxx * wy - wx * wxy) / determinant : wy / w;
  }
  return result;
}

int turns(const std::vector<double>& values, double least) {
  int count = 0, way = 0;
  double low = values.empty() ? 0 : values.front(), high = low;  // since the last turn
  for (const double value : values) {
    low = std::min(low, value), high = std::max(high, value);
    const bool up = way <= 0 && value - low > least, down = way >= 0 && high - value > least;
    if (!up && !down) continue;
    count += way != 0;
    way = up ? 1 : -1;
    low = high = value;
  }
  return count;
}

}  // namespace tack
