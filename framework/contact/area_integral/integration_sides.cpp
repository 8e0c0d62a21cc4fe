#include "framework/contact/area_integral/integration_sides.hpp"

#include <algorithm>
#include <iterator>

namespace tack {
namespace {

constexpr double equal_overlap_ratio_min = 0.9;  // of the larger overlap area
constexpr double kept_overlap_ratio_min = 0.7;   // of the larger overlap area, to keep a side

}  // namespace

bool IntegrationSides::first_integrates(std::pair<int, int> pair, const Both& overlaps) const {
  const auto& [first, second] = overlaps;
  const bool finer = pairs_.finer(pair.first, pair.second);
  if (previous_) {
    const bool was_first = finer != contains(*previous_, pair);
    if (contains(kept_, pair) || (was_first ? first : second).area >= kept_overlap_ratio_min * std::max(first.area, second.area)) return was_first;
  }
  const double equal = equal_overlap_ratio_min * std::max(first.area, second.area);
  if (first.area < equal) return false;
  if (second.area < equal) return true;
  if (first.triangles != second.triangles) return first.triangles > second.triangles;
  return finer;
}

// Pairs without overlap keep their sides.
void IntegrationSides::choose() {
  coarse_pairs_.clear();
  for (const auto& [pair, overlaps] : overlaps_)
    if (first_integrates(pair, overlaps) != pairs_.finer(pair.first, pair.second)) coarse_pairs_.push_back(pair);
  if (!previous_) return;
  const auto chosen = static_cast<std::ptrdiff_t>(coarse_pairs_.size());
  std::copy_if(previous_->begin(), previous_->end(), std::back_inserter(coarse_pairs_), [&](const auto& pair) { return !overlaps_.contains(pair); });
  std::inplace_merge(coarse_pairs_.begin(), coarse_pairs_.begin() + chosen, coarse_pairs_.end());
}

}  // namespace tack
