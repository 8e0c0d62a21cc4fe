#include "framework/checks/difference_study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tack {
namespace {

constexpr int window = 4;
// Means of rounding errors exceed their spread by these factors once in a million components.
constexpr double own_spreads = 30, typical_spreads = 3;

struct Limit {
  double value = 0, spread = 0, round_off = 0;
};

// Returns the limit of component i over the window of its smallest errors: a wrong derivative has
// no small errors, while beyond a kink of the second derivative, or below rounding, right ones have
// large errors too.
Limit limit_of(const std::vector<VecX>& extrapolated, Eigen::Index i) {
  Limit best;
  double least = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k + window <= extrapolated.size(); ++k) {
    double low = extrapolated[k](i), high = low, sum = 0;
    for (int j = 0; j < window; ++j) {
      const double e = extrapolated[k + j](i);
      low = std::min(low, e);
      high = std::max(high, e);
      sum += e;
    }
    const double largest = std::max(std::abs(low), std::abs(high));
    if (k == 0 || largest < least) best = {sum / window, high - low, 0};
    least = std::min(least, largest);
  }
  return best;
}

double percentile(std::vector<double> values, double part) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1) + 0.999);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

void DifferenceStudy::merge(const DifferenceStudy& other) {
  scale = std::max(scale, other.scale);
  components += other.components;
  unclear += other.unclear;
  const bool worse = other.wrong == wrong ? !(other.error <= error) : other.wrong;
  if (worse) {
    error = other.error;
    resolution = other.resolution;
  }
  wrong = wrong || other.wrong;
}

DifferenceStudy study_differences(const std::vector<VecX>& errors, const VecX& scales, double tolerance,
                                  const VecX& round_off) {
  constexpr double order = DifferenceStudy::ratio * DifferenceStudy::ratio;
  std::vector<VecX> extrapolated;
  for (size_t k = 0; k + 1 < errors.size(); ++k)
    extrapolated.push_back((order * errors[k + 1] - errors[k]) / (order - 1));
  // A component that is zero but for rounding is judged by the others' scale.
  const double largest = scales.size() > 0 ? scales.maxCoeff() : 0;
  std::vector<Limit> limits;
  std::vector<double> spreads;
  DifferenceStudy study;
  study.scale = largest;
  for (Eigen::Index i = 0; i < scales.size(); ++i) {
    Limit limit = limit_of(extrapolated, i);
    const double scale = std::max(scales(i), 1e-9 * largest) + std::abs(limit.value);
    if (scale == 0) continue;
    study.scale = std::max(study.scale, std::abs(limit.value));
    limits.push_back({std::abs(limit.value) / scale, limit.spread / scale, round_off.size() > 0 ? round_off(i) / scale : 0});
    spreads.push_back(limits.back().spread);
  }
  study.resolution = percentile(std::move(spreads), 0.95);
  study.components = static_cast<int>(limits.size());
  for (const Limit& l : limits) {
    const bool small = l.value <= tolerance + typical_spreads * study.resolution + l.round_off;
    if (!small && l.value <= own_spreads * l.spread) {
      ++study.unclear;
      continue;
    }
    study.wrong = study.wrong || !small;
    if (!(l.value <= study.error)) study.error = l.value;
  }
  return study;
}

}  // namespace tack
