#include "framework/plot/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tack {

Plot within(Plot plot, double low, double high) {
  for (Curve& c : plot.curves) {
    Curve kept{c.title, {}, {}, c.scattered};
    bool left = false;  // the curve has left the range since the last point
    for (size_t i = 0; i < c.points.size(); ++i) {
      if (!(c.points[i].first >= low && c.points[i].first <= high)) {
        left = !kept.points.empty();
        continue;
      }
      if (left) {
        kept.points.emplace_back(std::nan(""), 0);
        if (!c.spread.empty()) kept.spread.emplace_back(0, 0);
        left = false;
      }
      kept.points.push_back(c.points[i]);
      if (!c.spread.empty()) kept.spread.push_back(c.spread[i]);
    }
    c = std::move(kept);
  }
  return plot;
}

namespace {

// Returns whether curves have the same points; NaN, which breaks a curve, equals NaN.
bool same_points(const Curve& a, const Curve& b) {
  const auto equal = [](double p, double q) { return p == q || (std::isnan(p) && std::isnan(q)); };
  return std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), [&](const auto& p, const auto& q) { return equal(p.first, q.first) && equal(p.second, q.second); });
}

}  // namespace

std::vector<Curve> merged_curves(const std::vector<Curve>& curves) {
  std::vector<Curve> merged;
  for (const Curve& c : curves) {
    const auto same = std::find_if(merged.begin(), merged.end(), [&](const Curve& m) { return !c.points.empty() && same_points(m, c) && m.scattered == c.scattered; });
    if (same == merged.end()) merged.push_back(c);
    else same->title += ", " + c.title;
  }
  return merged;
}

double AxisRange::position(double value) const {
  const auto scale = [this](double v) { return log ? std::log(v) : v; };
  return (scale(value) - scale(low)) / (scale(high) - scale(low));
}

std::optional<AxisRange> range_of(const std::vector<double>& numbers, bool log) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double v : numbers) {
    if (!std::isfinite(v) || (log && v <= 0)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  if (low > high) return std::nullopt;
  if (log) {
    const double factor = high > low ? std::pow(high / low, 0.05) : 2;
    return AxisRange{low / factor, high * factor, true};
  }
  const double margin = high > low ? (high - low) / 20 : std::max(std::abs(high) / 2, 1e-300);
  return AxisRange{low - margin, high + margin, false};
}

std::vector<double> log_ticks(const AxisRange& range) {
  std::vector<double> ticks;
  const double decades = std::log10(range.high / range.low);
  if (decades < 0.7) {  // as on a linear axis
    const double rough = (range.high - range.low) / 4, power = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = power * (rough / power < 1.5 ? 1 : rough / power < 3.5 ? 2 : rough / power < 7.5 ? 5 : 10);
    for (double i = std::ceil(range.low / step); i * step <= range.high; ++i) ticks.push_back(i * step);
    return ticks;
  }
  const int every = std::max(1, static_cast<int>(decades / 8));
  for (int e = static_cast<int>(std::floor(std::log10(range.low))); e <= std::ceil(std::log10(range.high)); ++e) {
    if (decades > 2 && e % every != 0) continue;
    for (const double digit : {1.0, 2.0, 5.0}) {
      if (decades > 2 && digit > 1) break;
      const double tick = digit * std::pow(10.0, e);
      if (tick >= range.low && tick <= range.high) ticks.push_back(tick);
    }
  }
  return ticks;
}

std::optional<std::vector<double>> separate_labels(const std::vector<double>& wanted, double apart) {
  const size_t n = wanted.size();
  if (n > 0 && static_cast<double>(n - 1) * apart > 1) return std::nullopt;
  std::vector<size_t> order(n);
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return wanted[a] < wanted[b]; });
  // Touching labels form a group, which is centred at the mean of their wanted heights, within the
  // picture.
  struct Group {
    double sum;
    size_t count;
  };
  const auto foot = [&](const Group& g) {
    const double height = static_cast<double>(g.count - 1) * apart;
    return std::clamp(g.sum / static_cast<double>(g.count) - height / 2, 0.0, 1 - height);
  };
  std::vector<Group> groups;
  for (const size_t i : order) {
    groups.push_back({std::clamp(wanted[i], 0.0, 1.0), 1});
    while (groups.size() > 1) {
      const Group &below = groups[groups.size() - 2], &above = groups.back();
      if (foot(above) - foot(below) >= static_cast<double>(below.count) * apart - 1e-12) break;
      groups[groups.size() - 2] = {below.sum + above.sum, below.count + above.count};
      groups.pop_back();
    }
  }
  std::vector<double> heights(n);
  size_t k = 0;
  for (const Group& g : groups)
    for (size_t i = 0; i < g.count; ++i) heights[order[k++]] = foot(g) + static_cast<double>(i) * apart;
  return heights;
}

}  // namespace tack
