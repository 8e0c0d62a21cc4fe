// How far a motion takes an adhesion of the gap (core/debonding.hpp).
#pragma once

#include <algorithm>

#include "framework/contact/laws/pair_law.hpp"
#include "framework/core/debonding.hpp"

namespace tack {

// Negative tangent over secant stiffness from which a law softens, above rounding errors.
inline constexpr double softening_ratio_min = 1e-6;

inline bool softens(const PairLaw& law, double distance) {
  const LawSample s = law.at(distance);
  return s.slope > 0 && s.curvature * (distance - law.offset()) < -softening_ratio_min * s.slope;
}

// The adhesion of a pair law.
struct AdhesionOfGap {
  const PairLaw& law;          // adhesion alone
  double range = 0, work = 0;  // its range, offset included [m], and work [J/m^2]; 0: none

  explicit AdhesionOfGap(const PairLaw& adhesion) : law(adhesion) {
    if (!law.laws().empty()) range = law.range();
    for (const auto& part : law.laws())
      work += dynamic_cast<const NormalAdhesion&>(*part).work_of_adhesion();
  }
};

// Returns the marks (DebondingMark) of a motion from `distance` to `end` [m]. law: the sum of
// barrier and adhesion, whose peak counts.
inline char debonding_marks(const PairLaw& law, const AdhesionOfGap& adhesion, double distance,
                            double end) {
  if (!(distance < adhesion.range)) return 0;
  char marks = adheres;
  if (!(end > distance) || (end < adhesion.range && !softens(law, end))) return marks;
  if (!softens(law, distance)) marks |= passes_peak;
  const LawSample a = adhesion.law.at(distance), b = adhesion.law.at(end);
  const double taken = std::max(b.value - a.value, (a.slope + b.slope) / 2 * (end - distance));
  if (taken > debonding_work_max * adhesion.work) marks |= passes_over;
  return marks;
}

}  // namespace tack
