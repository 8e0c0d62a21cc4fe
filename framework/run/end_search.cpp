#include "framework/run/end_search.hpp"

#include <algorithm>
#include <cmath>

namespace tack {
namespace {

constexpr double bracket_margin = 0.05;    // least distance of a try from the ends of the bracket, over its length
constexpr int bisection_turn = 3;  // every third try bisects
constexpr int end_tries_max = 60;      // of a step; bisection alone shortens the bracket by 2^-20

bool met_in(const EndSearch::Excess& e) { return e.value >= 0; }
bool near(const EndSearch::Excess& e) { return e.error > 0 && std::abs(e.value) <= e.error; }

}  // namespace

void EndSearch::begin(double t, std::vector<Excess> start) {
  low_ = t;
  high_.reset();
  at_low_ = std::move(start);
  last_ = false;
  tries_ = 0;
  met_ = -1;
}

// An end that is met although the step has hardly begun was met before it: the shortest step ends it.
std::optional<double> EndSearch::next(double t, const std::vector<Excess>& excess) {
  const auto first_met = std::find_if(excess.begin(), excess.end(), met_in), first_near = std::find_if(excess.begin(), excess.end(), near);
  const bool any_met = first_met != excess.end();
  if (!any_met && !high_) {
    met_ = first_near == excess.end() ? -1 : static_cast<int>(first_near - excess.begin());
    return std::nullopt;
  }
  const bool far = std::any_of(excess.begin(), excess.end(), [](const Excess& e) { return met_in(e) && !near(e); });
  const bool shortest = t - low_ <= tolerance_ * (1 + 1e-9) || last_ || ++tries_ >= end_tries_max;
  if (any_met && (!far || shortest)) {
    met_ = static_cast<int>(first_met - excess.begin());
    return std::nullopt;
  }
  if (!any_met && first_near != excess.end()) {
    met_ = static_cast<int>(first_near - excess.begin());
    return std::nullopt;
  }
  if (any_met) high_ = t, at_high_ = excess;
  else low_ = t, at_low_ = excess;
  return inside();
}

// Returns a time inside the bracket, or its end once it is short.
std::optional<double> EndSearch::inside() {
  const double length = *high_ - low_;
  if (length <= tolerance_) {
    last_ = true;
    return *high_;
  }
  const double shortest = low_ + std::max(bracket_margin * length, std::min(tolerance_, length / 2)), longest = *high_ - bracket_margin * length;
  // The earliest end decides. It may be later than the middle if the secants of all ends are known.
  double earliest = *high_;
  bool all_known = true;
  for (size_t i = 0; i < at_high_.size(); ++i) {
    const Excess &low = at_low_[i], &high = at_high_[i];
    if (!met_in(high)) continue;
    if (met_in(low)) return low_ + std::min(tolerance_, length / 2);  // met from the start
    if (tries_ % bisection_turn == 0 || !std::isfinite(low.value) || high.error == 0) all_known = false;
    else earliest = std::min(earliest, low_ + length * (high.error / 2 - low.value) / (high.value - low.value));
  }
  const double time = all_known ? earliest : std::min(earliest, low_ + length / 2);
  return std::clamp(time, shortest, std::max(shortest, longest));
}

}  // namespace tack
