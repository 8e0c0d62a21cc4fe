#include "framework/contact/laws/law_root.hpp"

#include <algorithm>
#include <cmath>

namespace tack {
namespace {

// Distance to d*, relative to d*, below which rounding dominates the root of the difference.
constexpr double linear_range_per_gap = 1e-5;

}  // namespace

LawRoot::LawRoot(const PairLaw& law) : gap_(law.range()), offset_(law.offset()) {
  const PairLaw::Well well = law.well();
  if (!(well.depth > 0)) return;
  gap_ = well.gap + offset_;
  for (int i = 0; i < 10; ++i) {  // golden section finds d* to half of the digits only
    const LawSample phi = law.at(gap_);
    if (!(phi.curvature > 0)) break;
    gap_ -= std::clamp(phi.slope / phi.curvature, -linear_range_per_gap * well.gap, linear_range_per_gap * well.gap);
  }
  const LawSample lowest = law.at(gap_);
  depth_ = -lowest.value;
  stiffness_ = std::sqrt(std::max(lowest.curvature, 0.0));
}

LawRoot::Sample LawRoot::at(double d, const LawSample& phi) const {
  if (stiffness_ > 0 && std::abs(d - gap_) < linear_range_per_gap * (gap_ - offset_)) return {phi.slope / stiffness_, stiffness_};
  const double energy = phi.value + depth_;
  if (!(energy > 0)) return {};  // at and beyond the range of a law that only repels
  const double root = std::copysign(std::sqrt(2 * energy), d - gap_);
  return {root, phi.slope / root};
}

}  // namespace tack
