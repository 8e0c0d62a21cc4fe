#include "geometry/curves/cubic_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tack {
namespace {

void check_knots(const std::vector<double>& x, const std::vector<double>& values) {
  if (x.size() < 2 || values.size() != x.size()) throw std::logic_error("a curve needs two knots, and one value each");
  for (size_t i = 0; i < x.size(); ++i)
    if (!std::isfinite(x[i]) || !std::isfinite(values[i]) || (i > 0 && !(x[i] > x[i - 1]))) throw std::logic_error("knots of a curve must be finite and ascend");
}

// Returns the slope at the first point of the parabola through the first three, limited to be monotone. h: widths; d: secants.
double end_slope(double h0, double h1, double d0, double d1) {
  const double slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (slope * d0 <= 0) return 0;
  if (d0 * d1 <= 0 && std::abs(slope) > 3 * std::abs(d0)) return 3 * d0;
  return slope;
}

std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  const size_t n = x.size();
  std::vector<double> h(n - 1), d(n - 1), m(n, 0.0);
  for (size_t i = 0; i + 1 < n; ++i) h[i] = x[i + 1] - x[i], d[i] = (y[i + 1] - y[i]) / h[i];
  if (n == 2) return {d[0], d[0]};
  for (size_t i = 1; i + 1 < n; ++i) {
    if (d[i - 1] * d[i] <= 0) continue;
    const double a = 2 * h[i] + h[i - 1], b = h[i] + 2 * h[i - 1];
    m[i] = (a + b) / (a / d[i - 1] + b / d[i]);
  }
  m[0] = end_slope(h[0], h[1], d[0], d[1]);
  m[n - 1] = end_slope(h[n - 2], h[n - 3], d[n - 2], d[n - 3]);
  return m;
}

}  // namespace

CubicCurve::CubicCurve(const std::vector<double>& x, const std::vector<double>& values, const std::vector<double>& slopes) : pieces_(x.size()) {
  check_knots(x, values);
  const size_t n = x.size();
  for (size_t i = 0; i < n; ++i) pieces_[i].x = x[i], pieces_[i].y = values[i], pieces_[i].m = slopes.at(i);
  std::vector<double> areas(n, 0.0);
  for (size_t i = 0; i + 1 < n; ++i) {
    Piece& p = pieces_[i];
    const double h = x[i + 1] - x[i], secant = (values[i + 1] - values[i]) / h, m = slopes[i], m_end = slopes[i + 1];
    p.c = (3 * secant - 2 * m - m_end) / h;
    p.c_end = (m + 2 * m_end - 3 * secant) / h;
    p.k = (m + m_end - 2 * secant) / (h * h);
    areas[i] = h * ((values[i] + values[i + 1]) / 2 + h * (m - m_end) / 12);
  }
  for (size_t i = 1; i < n; ++i) pieces_[i].integral = pieces_[i - 1].integral + areas[i - 1];
  for (size_t i = n - 1; i-- > 0;) pieces_[i].rest = pieces_[i + 1].rest + areas[i];
  find_starts();
}

CubicCurve CubicCurve::monotone(const std::vector<double>& x, const std::vector<double>& values) {
  check_knots(x, values);
  return CubicCurve(x, values, monotone_slopes(x, values));
}

void CubicCurve::find_starts() {
  const int bins = knots() - 1;
  bins_per_x_ = bins / (last() - first());
  starts_.resize(bins + 1);
  int piece = 0;
  for (int i = 0; i <= bins; ++i) {
    const double x = first() + i / bins_per_x_;
    while (piece + 2 < knots() && pieces_[piece + 1].x <= x) ++piece;
    starts_[i] = piece;
  }
}

int CubicCurve::piece_at(double x) const {
  const int bin = std::min(static_cast<int>((x - first()) * bins_per_x_), knots() - 2);
  const auto begin = pieces_.begin() + starts_[bin], end = pieces_.begin() + starts_[bin + 1] + 1;
  int i = static_cast<int>(std::upper_bound(begin, end, x, [](double at, const Piece& p) { return at < p.x; }) - pieces_.begin()) - 1;
  i = std::clamp(i, 0, knots() - 2);
  while (i > 0 && x < pieces_[i].x) --i;  // round-off at bin boundaries
  while (i < knots() - 2 && x >= pieces_[i + 1].x) ++i;
  return i;
}

CubicCurve::Sample CubicCurve::at(double x) const {
  if (!(x > first())) return {pieces_.front().y, 0, pieces_.front().y * (x - first()), pieces_.front().rest - pieces_.front().y * (x - first())};
  if (!(x < last())) return {pieces_.back().y, 0, total() + pieces_.back().y * (x - last()), -pieces_.back().y * (x - last())};
  const int i = piece_at(x);
  const Piece &p = pieces_[i], &q = pieces_[i + 1];
  const double t = x - p.x, s = q.x - x;
  const double integral = p.integral + t * (p.y + t * (p.m / 2 + t * (p.c / 3 + t * p.k / 4)));
  const double rest = q.rest + s * (q.y - s * (q.m / 2 - s * (p.c_end / 3 - s * p.k / 4)));
  // from the nearer knot, without cancellation beside a zero there
  if (t < s) return {p.y + t * (p.m + t * (p.c + t * p.k)), p.m + t * (2 * p.c + 3 * t * p.k), integral, rest};
  return {q.y - s * (q.m - s * (p.c_end - s * p.k)), q.m - s * (2 * p.c_end - 3 * s * p.k), integral, rest};
}

template <class Act>
void CubicCurve::for_each_extreme(int piece, const Act& act) const {
  const Piece &p = pieces_[piece], &q = pieces_[piece + 1];
  const double h = q.x - p.x, discriminant = p.c * p.c - 3 * p.k * p.m;
  act(p.x, p.y);
  if (discriminant >= 0) {  // roots of m + 2 c t + 3 k t^2, without cancellation
    const double sum = -(p.c + std::copysign(std::sqrt(discriminant), p.c));
    double roots[2] = {p.m / sum, sum / (3 * p.k)};
    if (roots[1] < roots[0]) std::swap(roots[0], roots[1]);
    for (const double t : roots)
      if (t > 0 && t < h) act(p.x + t, p.y + t * (p.m + t * (p.c + t * p.k)));
  }
  act(q.x, q.y);
}

CubicCurve::Point CubicCurve::largest(double from) const {
  const Sample start = at(from);
  Point best{from, start.value};
  for (int i = 0; i + 1 < knots(); ++i)
    for_each_extreme(i, [&](double x, double value) {
      if (x >= from && value > best.value) best = {x, value};
    });
  return best;
}

CubicCurve::Point CubicCurve::least() const {
  Point best{first(), pieces_.front().y};
  for (int i = 0; i + 1 < knots(); ++i)
    for_each_extreme(i, [&](double x, double value) {
      if (value < best.value) best = {x, value};
    });
  return best;
}

}  // namespace tack
