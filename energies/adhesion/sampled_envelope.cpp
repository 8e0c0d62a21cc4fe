#include "energies/adhesion/sampled_envelope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr int places = 4000;
constexpr double least_start = 1e-6;     // of the peak: what begins with more does not begin at 0
constexpr double largest_misfit = 0.01;  // of the peak

}  // namespace

SampledEnvelope::SampledEnvelope(const std::function<double(double)>& traction, double end, const char* what) : end_(end) {
  const auto knots = std::make_shared<Knots>();
  std::vector<double>&squared = knots->squared, &damage = knots->damage;
  squared.resize(places + 1), damage.resize(places + 1);
  std::vector<double> pull(places + 1);
  double peak = 0;
  const auto at = [&](int i) { return end * i / places; };
  for (int i = 0; i <= places; ++i) {
    squared[i] = at(i) * at(i);
    pull[i] = i < places ? traction(at(i)) : 0;
    peak = std::max(peak, pull[i]);
    if (i > 0) stiffness_ = std::max(stiffness_, pull[i] / at(i));
  }
  if (std::abs(traction(1e-9 * end)) > least_start * peak)
    throw InputError(fmt::format("{}: its traction begins with {:.4g} Pa; bonds that are damaged come back to the origin: let it begin with 0 (and "
                                 "rise over a short way)", what, traction(1e-9 * end)));
  for (int i = 1; i <= places; ++i) {
    damage[i] = std::clamp(1 - pull[i] / (stiffness_ * at(i)), damage[i - 1], 1.0);
    const double follows = (1 - damage[i]) * stiffness_ * at(i);
    if (std::abs(follows - pull[i]) > largest_misfit * peak)
      throw InputError(fmt::format("{}: its traction per opening rises to {:.4g} Pa/m at {:.6g} m: damage only grows, and cannot follow what gets "
                                   "stiffer; let the traction rise linearly, or ever more slowly", what, pull[i] / at(i), at(i)));
  }
  knots_ = knots;
  damage_ = std::make_shared<const CubicCurve>(CubicCurve::monotone(squared, damage));
}

double SampledEnvelope::damage(double opening) const { return opening < end_ ? std::clamp(damage_->at(opening * opening).value, 0.0, 1.0) : 1; }

double SampledEnvelope::growth(double opening) const { return opening < end_ ? 2 * opening * damage_->at(opening * opening).slope : 0; }

double SampledEnvelope::opening(double damage) const { return std::sqrt(squared_opening(damage)); }

double SampledEnvelope::spent(double damage) const {
  const double z = squared_opening(damage);
  return stiffness_ / 2 * (z * damage - damage_->at(z).integral);
}

// The largest at which there is no more damage than that: Newton's method within bisection, in the piece that has it.
double SampledEnvelope::squared_opening(double damage) const {
  if (damage >= 1) return end_ * end_;
  const auto above = std::upper_bound(knots_->damage.begin(), knots_->damage.end(), damage) - knots_->damage.begin();
  double low = above > 0 ? knots_->squared[above - 1] : 0, high = knots_->squared[above], z = low;
  for (int i = 0; i < 200; ++i) {
    const CubicCurve::Sample s = damage_->at(z);
    (s.value <= damage ? low : high) = z;
    const double newton = z - (s.value - damage) / s.slope;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (!(low < next && next < high) || std::abs(next - z) <= 1e-15 * next) return next;
    z = next;
  }
  return z;
}

}  // namespace tack
