#include "geometry/curves/adaptive_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tack {
namespace {

constexpr int interval_count_start = 128;
constexpr double interval_ratio_min = 1e-9;  // shortest interval over last - first
constexpr std::array<double, 3> test_points = {0.5, 0.22, 0.78};  // fractions of an interval; an odd error vanishes at its middle

struct Jet {
  double value = 0, slope = 0;
};
// Returns value and slope at x, from values within `radius` of x and between first and last.
using JetOf = std::function<Jet(double x, double radius)>;

struct Knot {
  double x = 0, radius = 0;
  Jet jet;
};
struct Interval {
  double error = 0;  // absolute
};

double hermite(const Knot& a, const Knot& b, double u) {
  const double h = b.x - a.x, v = 1 - u;
  return a.jet.value * v * v * (1 + 2 * u) + b.jet.value * u * u * (1 + 2 * v) + h * u * v * (v * a.jet.slope - u * b.jet.slope);
}

class Refinement {
 public:
  Refinement(const JetOf& jet, double first, double last) : jet_(jet), width_(last - first) {
    for (int i = 0; i <= interval_count_start; ++i) knots_.push_back({i == interval_count_start ? last : first + i * width_ / interval_count_start, 0, {}});
    intervals_.resize(interval_count_start);
  }

  AdaptiveCurve run() {
    do evaluate();
    while (bisect());
    AdaptiveCurve result;
    std::vector<double> x, values, slopes;
    for (const Knot& k : knots_) x.push_back(k.x), values.push_back(k.jet.value), slopes.push_back(k.jet.slope);
    result.curve = CubicCurve(x, values, slopes);
    for (size_t i = 0; i < intervals_.size(); ++i)
      if (const double error = largest_ > 0 ? intervals_[i].error / largest_ : 0; error > result.error)
        result.error = error, result.worst_from = knots_[i].x, result.worst_to = knots_[i + 1].x;
    return result;
  }

 private:
  double length(size_t i) const { return knots_[i + 1].x - knots_[i].x; }

  // Evaluates knots and errors. Differences stay within the nearest knot: past it there may be a kink.
  void evaluate() {
    std::vector<char> changed(knots_.size(), 0);
    for (size_t i = 0; i < knots_.size(); ++i) {
      Knot& k = knots_[i];
      const double left = i > 0 ? length(i - 1) : length(0), right = i + 1 < knots_.size() ? length(i) : left, radius = std::min(left, right);
      if (k.radius == radius) continue;
      k.jet = jet_(k.x, k.radius = radius);
      largest_ = std::max(largest_, std::abs(k.jet.value));
      changed[i] = 1;
    }
    for (size_t i = 0; i < intervals_.size(); ++i) {
      Interval& one = intervals_[i];
      if (!changed[i] && !changed[i + 1]) continue;
      one.error = 0;
      for (const double u : test_points) {
        const double x = knots_[i].x + u * length(i), value = jet_(x, std::min(u, 1 - u) * length(i)).value;
        largest_ = std::max(largest_, std::abs(value));
        one.error = std::max(one.error, std::abs(value - hermite(knots_[i], knots_[i + 1], u)));
      }
    }
  }

  // Bisects intervals above the tolerance, the worst first while knots are left. Returns false if there are none.
  bool bisect() {
    std::vector<size_t> worst;
    for (size_t i = 0; i < intervals_.size(); ++i)
      if (intervals_[i].error > AdaptiveCurve::tolerance * largest_ && length(i) > 2 * interval_ratio_min * width_) worst.push_back(i);
    const size_t free_knots = AdaptiveCurve::most_knots - knots_.size();
    if (worst.size() > free_knots) {
      std::stable_sort(worst.begin(), worst.end(), [&](size_t a, size_t b) { return intervals_[a].error > intervals_[b].error; });
      worst.resize(free_knots);
      std::sort(worst.begin(), worst.end());
    }
    if (worst.empty()) return false;
    std::vector<Knot> knots;
    std::vector<Interval> intervals;
    auto next = worst.begin();
    for (size_t i = 0; i < intervals_.size(); ++i) {
      knots.push_back(knots_[i]);
      intervals.push_back(intervals_[i]);
      if (next == worst.end() || *next != i) continue;
      ++next;
      knots.push_back({0.5 * (knots_[i].x + knots_[i + 1].x), 0, {}});
      intervals.push_back({});
    }
    knots.push_back(knots_.back());
    knots_ = std::move(knots), intervals_ = std::move(intervals);
    return true;
  }

  const JetOf& jet_;
  double width_, largest_ = 0;
  std::vector<Knot> knots_;
  std::vector<Interval> intervals_;  // interval i: from knot i to knot i + 1
};

}  // namespace

AdaptiveCurve adaptive_curve(const std::function<double(double)>& f, double first, double last) {
  constexpr double step_ratio = 1e-3;  // the error of differences is negligible beside that of the cubic
  const JetOf jet = [&](double x, double radius) -> Jet {
    const double h = step_ratio * radius, value = f(x);
    if (x - h < first || x + h > last) {  // one-sided, by a parabola
      const double signed_h = x - h < first ? h : -h, near = x + signed_h, far = x + 2 * signed_h;
      const double a = (f(near) - value) / (near - x), b = (f(far) - value) / (far - x);
      return {value, 2 * a - b};
    }
    const double up = x + h, down = x - h;
    return {value, (f(up) - f(down)) / (up - down)};
  };
  return Refinement(jet, first, last).run();
}

AdaptiveCurve adaptive_derivative(const std::function<double(double)>& f, double first, double last) {
  constexpr double step_ratio = 1.0 / 16;  // differences of fourth order
  const JetOf jet = [&](double x, double radius) -> Jet {
    double h = step_ratio * radius;
    h = (x + h) - x;  // exactly representable difference of the positions
    if (!(h > 0)) h = step_ratio * radius;
    if (x - 2 * h < first || x + 2 * h > last) {
      const double s = x - 2 * h < first ? h : -h;
      const double a = f(x), b = f(x + s), c = f(x + 2 * s), d = f(x + 3 * s), e = f(x + 4 * s);
      return {(-25 * a + 48 * b - 36 * c + 16 * d - 3 * e) / (12 * s), (35 * a - 104 * b + 114 * c - 56 * d + 11 * e) / (12 * s * s)};
    }
    const double a = f(x - 2 * h), b = f(x - h), c = f(x), d = f(x + h), e = f(x + 2 * h);
    return {(a - 8 * b + 8 * d - e) / (12 * h), (-a + 16 * b - 30 * c + 16 * d - e) / (12 * h * h)};
  };
  return Refinement(jet, first, last).run();
}

}  // namespace tack
