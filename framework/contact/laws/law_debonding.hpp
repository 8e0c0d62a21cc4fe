// Whether a motion takes a surface past the peak of an adhesion of the gap.
#pragma once

#include "framework/contact/laws/pair_law.hpp"

namespace tack {

// Negative tangent over secant stiffness from which a law softens, above rounding errors.
inline constexpr double softening_ratio_min = 1e-6;

inline bool softens(const PairLaw& law, double distance) {
  const LawSample s = law.at(distance);
  return s.slope > 0 && s.curvature * (distance - law.offset()) < -softening_ratio_min * s.slope;
}

// Returns whether the law passes its peak from `distance` to `end`: it does not soften at the
// first, and softens or is out of range at the second, which is larger.
inline bool passes_peak(const PairLaw& law, double range, double distance, double end) {
  return end > distance && distance < range && (!(end < range) || softens(law, end)) &&
         !softens(law, distance);
}

}  // namespace tack
