// Largest traction of a traction-separation law, and its gap.
#pragma once

#include "framework/contact/normal_law.hpp"

namespace tack {

struct LawPeak {
  double gap = 0, traction = 0;  // m, Pa; both 0 for a law that only repels
};

// Returns the peak, found numerically. Limit: of two peaks closer than 1/2000 of the range, either
// one is found.
LawPeak largest_traction(const NormalLaw& law);

// Returns the largest gap with more than this traction, to 1/4000 of the range [m]; 0: none.
double last_gap_with(const NormalLaw& law, double traction);

}  // namespace tack
