#include "framework/measured/follow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tack {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double slack = 1e-9;  // of the run's range: sums of steps end a little off

// A place on the run's polyline: between two samples.
struct Place {
  size_t segment = 0;
  double part = 0;
};

class Run {
 public:
  Run(std::span<const double> x, std::span<const double> y) : x_(x), y_(y) {
    if (x.empty()) return;
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    low_ = *low;
    high_ = *high;
  }

  bool turns_back() const {
    return !std::is_sorted(x_.begin(), x_.end()) && !std::is_sorted(x_.rbegin(), x_.rend());
  }

  // The first passage of `wanted` from `place` on, upwards (1), downwards (-1) or any way (0); moves there.
  double pass(double wanted, int direction, Place& place) const {
    if (x_.empty()) return nan;
    const double reach = slack * (high_ - low_);
    if (wanted < low_ - reach || wanted > high_ + reach) return nan;
    wanted = std::clamp(wanted, low_, high_);
    if (x_.size() == 1) return y_[0];
    for (size_t i = place.segment; i + 1 < x_.size(); ++i) {
      const double before = x_[i], after = x_[i + 1];
      const bool upward = before <= wanted && wanted <= after, downward = before >= wanted && wanted >= after;
      if (!(direction > 0 ? upward : direction < 0 ? downward : upward || downward)) continue;
      const double part = after == before ? 0 : (wanted - before) / (after - before);
      if (i == place.segment && part < place.part) continue;
      place = {i, part};
      return (1 - part) * y_[i] + part * y_[i + 1];
    }
    return nan;
  }

 private:
  std::span<const double> x_, y_;
  double low_ = 0, high_ = 0;
};

// Up (1) or down (-1) at a point of the data: from the last one that differs, at the start to the next one.
int direction_at(std::span<const double> points, size_t i) {
  for (size_t k = i; k-- > 0;)
    if (points[k] != points[i]) return points[i] > points[k] ? 1 : -1;
  for (size_t k = i + 1; k < points.size(); ++k)
    if (points[k] != points[i]) return points[k] > points[i] ? 1 : -1;
  return 0;
}

}  // namespace

std::vector<double> follow(std::span<const double> points, std::span<const double> x, std::span<const double> y) {
  const Run run(x, y);
  const bool by_time = run.turns_back();
  std::vector<double> found;
  found.reserve(points.size());
  Place place;
  for (size_t i = 0; i < points.size(); ++i) {
    Place start;
    found.push_back(by_time ? run.pass(points[i], direction_at(points, i), place) : run.pass(points[i], 0, start));
  }
  return found;
}

}  // namespace tack
