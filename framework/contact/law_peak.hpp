// The largest traction of a law of the gap, and where.
#pragma once

#include "framework/contact/normal_law.hpp"

namespace tack {

struct LawPeak {
  double gap = 0, traction = 0;  // m, Pa; both 0 of what only pushes
};

// Found numerically: of two peaks that are less than a two-thousandth of the range apart, either
// one.
LawPeak largest_traction(const NormalLaw& law);

// The last gap at which it pulls with that much, to a four-thousandth of its range; 0: none [m].
double last_gap_with(const NormalLaw& law, double traction);

}  // namespace tack
