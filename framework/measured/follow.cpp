#include "framework/measured/follow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tack {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double slack = 1e-9;  // of the run's range: sums of steps have rounding errors

class RunAbscissa {
 public:
  RunAbscissa(std::span<const double> x, std::span<const size_t> starts) : x_(x), starts_(starts) {
    if (x.empty()) return;
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    low_ = *low;
    high_ = *high;
  }

  bool reverses_direction() const {
    for (size_t begin = 0; begin < x_.size();) {
      const size_t end = end_of_window(begin);
      const std::span<const double> x = x_.subspan(begin, end - begin);
      if (!std::is_sorted(x.begin(), x.end()) && !std::is_sorted(x.rbegin(), x.rend())) return true;
      begin = end;
    }
    return false;
  }

  // Returns the first passage of `target` from `position` on, and moves `position` there. direction:
  // upwards (1), downwards (-1), either (0).
  std::optional<Passage> pass(double target, int direction, Passage& position) const {
    if (x_.empty()) return std::nullopt;
    const double tolerance = slack * (high_ - low_);
    if (target < low_ - tolerance || target > high_ + tolerance) return std::nullopt;
    target = std::clamp(target, low_, high_);
    if (x_.size() == 1) return Passage{};
    for (size_t i = position.sample; i < x_.size(); ++i) {
      if (i + 1 == x_.size() || is_start(i + 1)) {
        if ((i == 0 || is_start(i)) && x_[i] == target) return position = {i, 0};  // the only sample of its window
        continue;
      }
      const double before = x_[i], after = x_[i + 1];
      const bool upward = before <= target && target <= after, downward = before >= target && target >= after;
      if (!(direction > 0 ? upward : direction < 0 ? downward : upward || downward)) continue;
      const double fraction = after == before ? 0 : (target - before) / (after - before);
      if (i == position.sample && fraction < position.fraction) continue;
      return position = {i, fraction};
    }
    return std::nullopt;
  }

 private:
  bool is_start(size_t i) const { return std::binary_search(starts_.begin(), starts_.end(), i); }
  size_t end_of_window(size_t sample) const {
    const auto next = std::upper_bound(starts_.begin(), starts_.end(), sample);
    return next == starts_.end() ? x_.size() : *next;
  }

  std::span<const double> x_;
  std::span<const size_t> starts_;
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

std::vector<std::optional<Passage>> passages(std::span<const double> points, std::span<const double> x, std::span<const size_t> starts) {
  const RunAbscissa run(x, starts);
  const bool reverses = run.reverses_direction();
  std::vector<std::optional<Passage>> found;
  found.reserve(points.size());
  Passage position;
  for (size_t i = 0; i < points.size(); ++i) {
    Passage start;
    found.push_back(reverses ? run.pass(points[i], direction_at(points, i), position) : run.pass(points[i], 0, start));
  }
  return found;
}

std::vector<double> follow(std::span<const double> points, std::span<const double> x, std::span<const double> y, std::span<const size_t> starts) {
  std::vector<double> found;
  found.reserve(points.size());
  for (const std::optional<Passage>& passage : passages(points, x, starts)) found.push_back(passage ? passage->value_of(y) : nan);
  return found;
}

}  // namespace tack
