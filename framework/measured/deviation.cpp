#include "framework/measured/deviation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tack {
namespace {

double relative(double difference, double scale) {
  return scale > 0 || difference == 0 ? difference / std::max(scale, std::numeric_limits<double>::min())
                                      : std::copysign(std::numeric_limits<double>::infinity(), difference);
}

}  // namespace

Deviation deviation_of(const MeasuredCurve& curve, const std::vector<double>& run, DeviationScale scale) {
  double peak = 0;
  for (const double y : curve.y) peak = std::max(peak, std::abs(y));
  Deviation d;
  double squares = 0;
  size_t last = 0;
  for (size_t i = 0; i < curve.size(); ++i) {
    if (std::isnan(run[i])) continue;
    const double off = relative(run[i] - curve.y[i], scale == DeviationScale::peak ? peak : std::abs(curve.y[i]));
    d.mean += std::abs(off);
    d.bias += off;
    squares += off * off;
    if (d.compared == 0 || std::abs(off) > d.worst) {
      d.worst = std::abs(off);
      d.worst_at = i;
    }
    if (d.compared > 0) {
      const double width = curve.x[i] - curve.x[last];
      d.work += 0.5 * width * (run[i] + run[last]);
      d.measured_work += 0.5 * width * (curve.y[i] + curve.y[last]);
    }
    last = i;
    ++d.compared;
  }
  const double count = static_cast<double>(std::max<size_t>(d.compared, 1));
  d.mean /= count;
  d.bias /= count;
  d.rms = std::sqrt(squares / count);
  return d;
}

}  // namespace tack
