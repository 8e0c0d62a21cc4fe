#include "framework/contact/laws/law_peak.hpp"

#include <algorithm>
#include <cmath>

namespace tack {

LawPeak largest_traction(const NormalLaw& law) {
  constexpr int intervals = 2000;
  const double width = law.range() / intervals;
  LawPeak peak;
  for (int i = 0; i < intervals; ++i)
    if (const double d = width * (i + 0.5), traction = law.at(d).slope; traction > peak.traction) peak = {d, traction};
  if (!(peak.traction > 0)) return {};
  // Golden section between the neighbouring intervals.
  double a = std::max(peak.gap - width, 1e-9 * width), b = std::min(peak.gap + width, law.range());
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  for (int i = 0; i < 60; ++i) {
    const double c = b - ratio * (b - a), d = a + ratio * (b - a);
    const double at_c = law.at(c).slope, at_d = law.at(d).slope;
    if (at_c > peak.traction) peak = {c, at_c};
    if (at_d > peak.traction) peak = {d, at_d};
    (at_c > at_d ? b : a) = at_c > at_d ? d : c;
  }
  return peak;
}

double last_gap_with(const NormalLaw& law, double traction) {
  constexpr int intervals = 4000;
  for (int i = intervals; i > 0; --i)
    if (const double gap = law.range() * i / intervals; law.at(gap * (1 - 1e-9)).slope > traction) return gap;
  return 0;
}

}  // namespace tack
