#include "framework/contact/integration_sides.hpp"

#include <algorithm>
#include <iterator>

namespace tack {
namespace {

constexpr double as_much = 0.9;       // of the larger capture
constexpr double nearly_as_much = 0.7;  // likewise, to keep a side

}  // namespace

bool IntegrationSides::first_integrates(std::pair<int, int> pair, const Both& captures) const {
  const auto& [first, second] = captures;
  const bool finer = pairs_.finer(pair.first, pair.second);
  if (before_) {
    const bool was_first = finer != holds(*before_, pair);
    if (holds(held_, pair) || (was_first ? first : second).area >= nearly_as_much * std::max(first.area, second.area)) return was_first;
  }
  const double much = as_much * std::max(first.area, second.area);
  if (first.area < much) return false;
  if (second.area < much) return true;
  if (first.triangles != second.triangles) return first.triangles > second.triangles;
  return finer;
}

// Pairs that capture nothing keep their sides.
void IntegrationSides::choose() {
  turned_.clear();
  for (const auto& [pair, captures] : captures_)
    if (first_integrates(pair, captures) != pairs_.finer(pair.first, pair.second)) turned_.push_back(pair);
  if (!before_) return;
  const auto chosen = static_cast<std::ptrdiff_t>(turned_.size());
  std::copy_if(before_->begin(), before_->end(), std::back_inserter(turned_), [&](const auto& pair) { return !captures_.contains(pair); });
  std::inplace_merge(turned_.begin(), turned_.begin() + chosen, turned_.end());
}

}  // namespace tack
