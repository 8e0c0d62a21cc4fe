#include "framework/measured/follow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tack {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double slack = 1e-9;  // of the run's range: accumulated steps end slightly off

class Run {
 public:
  explicit Run(std::span<const double> x) : x_(x) {
    if (x.empty()) return;
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    low_ = *low;
    high_ = *high;
  }

  bool turns_back() const {
    return !std::is_sorted(x_.begin(), x_.end()) && !std::is_sorted(x_.rbegin(), x_.rend());
  }

  // Returns the first passage of `wanted` from `place` on, and moves `place` there. direction:
  // upwards (1), downwards (-1), either (0).
  std::optional<Passage> pass(double wanted, int direction, Passage& place) const {
    if (x_.empty()) return std::nullopt;
    const double reach = slack * (high_ - low_);
    if (wanted < low_ - reach || wanted > high_ + reach) return std::nullopt;
    wanted = std::clamp(wanted, low_, high_);
    if (x_.size() == 1) return Passage{};
    for (size_t i = place.sample; i + 1 < x_.size(); ++i) {
      const double before = x_[i], after = x_[i + 1];
      const bool upward = before <= wanted && wanted <= after, downward = before >= wanted && wanted >= after;
      if (!(direction > 0 ? upward : direction < 0 ? downward : upward || downward)) continue;
      const double part = after == before ? 0 : (wanted - before) / (after - before);
      if (i == place.sample && part < place.part) continue;
      return place = {i, part};
    }
    return std::nullopt;
  }

 private:
  std::span<const double> x_;
  double low_ = 0, high_ = 0;
};

// Returns the direction of the data at a point, up (1) or down (-1): from the previous different
// point, or to the next one at the start.
int direction_at(std::span<const double> points, size_t i) {
  for (size_t k = i; k-- > 0;)
    if (points[k] != points[i]) return points[i] > points[k] ? 1 : -1;
  for (size_t k = i + 1; k < points.size(); ++k)
    if (points[k] != points[i]) return points[k] > points[i] ? 1 : -1;
  return 0;
}

}  // namespace

std::vector<std::optional<Passage>> passages(std::span<const double> points, std::span<const double> x) {
  const Run run(x);
  const bool by_time = run.turns_back();
  std::vector<std::optional<Passage>> found;
  found.reserve(points.size());
  Passage place;
  for (size_t i = 0; i < points.size(); ++i) {
    Passage start;
    found.push_back(by_time ? run.pass(points[i], direction_at(points, i), place) : run.pass(points[i], 0, start));
  }
  return found;
}

std::vector<double> follow(std::span<const double> points, std::span<const double> x, std::span<const double> y) {
  std::vector<double> found;
  found.reserve(points.size());
  for (const std::optional<Passage>& passage : passages(points, x)) found.push_back(passage ? passage->of(y) : nan);
  return found;
}

}  // namespace tack
