#include "geometry/curves/smoothed.hpp"

#include <algorithm>
#include <cmath>

namespace tack {

std::vector<double> smoothed(const std::vector<double>& x, const std::vector<double>& values, double half_width) {
  std::vector<double> result(x.size());
  size_t begin = 0, end = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    while (x[begin] <= x[i] - half_width) ++begin;
    while (end < x.size() && x[end] < x[i] + half_width) ++end;
    double w = 0, wx = 0, wxx = 0, wy = 0, wxy = 0;  // sums, with (x - x_i) / half_width
    for (size_t j = begin; j < end; ++j) {
      const double u = (x[j] - x[i]) / half_width, v = 1 - std::abs(u * u * u), weight = v * v * v;
      w += weight, wx += weight * u, wxx += weight * u * u, wy += weight * values[j], wxy += weight * u * values[j];
    }
    const double determinant = w * wxx - wx * wx;
    result[i] = determinant > 1e-12 * w * wxx ? (wxx * wy - wx * wxy) / determinant : wy / w;
  }
  return result;
}

int count_reversals(const std::vector<double>& values, double least) {
  int count = 0, direction = 0;
  double low = values.empty() ? 0 : values.front(), high = low;  // since the last reversal
  for (const double value : values) {
    low = std::min(low, value), high = std::max(high, value);
    const bool up = direction <= 0 && value - low > least, down = direction >= 0 && high - value > least;
    if (!up && !down) continue;
    count += direction != 0;
    direction = up ? 1 : -1;
    low = high = value;
  }
  return count;
}

}  // namespace tack
