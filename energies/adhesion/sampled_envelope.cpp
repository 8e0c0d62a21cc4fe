#include "energies/adhesion/sampled_envelope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/curves/cubic_curve.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr int openings = 4000;           // equally spaced
constexpr double least_start = 1e-6;     // fraction of the peak that a curve may begin with
constexpr double largest_misfit = 0.01;  // of the peak

}  // namespace

SampledEnvelope::SampledEnvelope(const std::function<double(double)>& traction, double end, const char* what) : end_(end) {
  std::vector<double> squared(openings + 1), damage(openings + 1), pull(openings + 1);
  double peak = 0;
  const auto at = [&](int i) { return end * i / openings; };
  for (int i = 0; i <= openings; ++i) {
    squared[i] = at(i) * at(i);
    pull[i] = i < openings ? traction(at(i)) : 0;
    peak = std::max(peak, pull[i]);
    if (i > 0) stiffness_ = std::max(stiffness_, pull[i] / at(i));
  }
  if (std::abs(traction(1e-9 * end)) > least_start * peak)
    throw InputError(fmt::format("{}: its traction begins with {:.4g} Pa; bonds that are damaged come back to the origin: let it begin with 0 (and "
                                 "rise over a short way)", what, traction(1e-9 * end)));
  for (int i = 1; i <= openings; ++i) {
    damage[i] = std::clamp(1 - pull[i] / (stiffness_ * at(i)), damage[i - 1], 1.0);
    const double follows = (1 - damage[i]) * stiffness_ * at(i);
    if (std::abs(follows - pull[i]) > largest_misfit * peak)
      throw InputError(fmt::format("{}: its traction per opening rises to {:.4g} Pa/m at {:.6g} m: damage only grows, and cannot follow what gets "
                                   "stiffer; let the traction rise linearly, or ever more slowly", what, pull[i] / at(i), at(i)));
  }
  const CubicCurve curve = CubicCurve::monotone(squared, damage);
  std::vector<Piece> pieces(openings + 1);
  for (int i = 0; i <= openings; ++i) {
    Piece& piece = pieces[i];
    piece.z = squared[i], piece.y = damage[i], piece.m = curve.at(squared[i]).slope;
    if (i == 0) continue;
    Piece& before = pieces[i - 1];
    const double width = piece.z - before.z, mean = (piece.y - before.y) / width;
    before.c = (3 * mean - 2 * before.m - piece.m) / width;
    before.k = (before.m + piece.m - 2 * mean) / (width * width);
    piece.integral = before.integral_to(width);
  }
  pieces_ = std::make_shared<const std::vector<Piece>>(std::move(pieces));
  pieces_per_opening_ = openings / end;
}

SampledEnvelope::Position SampledEnvelope::at(double opening) const {
  const Piece& piece = (*pieces_)[std::min(static_cast<int>(opening * pieces_per_opening_), openings - 1)];
  return {&piece, opening * opening - piece.z};
}

// Returns the largest opening without more damage: Newton's method within bisection.
SampledEnvelope::Position SampledEnvelope::position_of(double damage) const {
  if (damage >= 1) return {&pieces_->back(), 0};
  const auto above = std::upper_bound(pieces_->begin() + 1, pieces_->end(), damage, [](double value, const Piece& p) { return value < p.y; });
  const Piece& piece = *(above - 1);
  double low = 0, high = above->z - piece.z, t = 0;
  for (int i = 0; i < 100; ++i) {
    const double excess = piece.value(t) - damage;
    (excess <= 0 ? low : high) = t;
    const double newton = t - excess / piece.slope(t), least = 1e-15 * (piece.z + t);
    if (std::abs(newton - t) <= least || high - low <= least) break;
    t = newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  return {&piece, t};
}

double SampledEnvelope::damage(double opening) const {
  if (!(opening < end_)) return 1;
  const Position here = at(opening);
  return std::clamp(here.piece->value(here.t), 0.0, 1.0);
}

double SampledEnvelope::growth(double opening) const {
  if (!(opening < end_)) return 0;
  const Position here = at(opening);
  return 2 * opening * here.piece->slope(here.t);
}

double SampledEnvelope::opening(double damage) const {
  const Position there = position_of(damage);
  return std::sqrt(there.piece->z + there.t);
}

double SampledEnvelope::spent(double damage) const {
  const Position there = position_of(damage);
  return stiffness_ / 2 * ((there.piece->z + there.t) * damage - there.piece->integral_to(there.t));
}

}  // namespace tack
