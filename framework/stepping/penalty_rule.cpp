#include "framework/stepping/penalty_rule.hpp"

#include <algorithm>

namespace tack {
namespace {

constexpr double sufficient_decrease = 0.5;  // of the distance to the targets by a minimisation; beyond, the penalty grows (Nocedal and Wright, 17.4)
constexpr double penalty_growth = 10;        // (Nocedal and Wright, algorithm 17.4)
constexpr double penalty_ratio_max = 1e8;    // over the first penalty (Li et al. 2020)
constexpr double progress_min = 0.01;        // decrease of the distance that counts as progress
constexpr int max_idle_iterations = 30;      // without progress or a larger K; then the motion is blocked

}  // namespace

bool PenaltyRule::blocked() const { return stiffness_ > penalty_ratio_max * first_ || idle_ > max_idle_iterations; }

double PenaltyRule::norm(double distance, double own_step) {
  if (distance < (1 - progress_min) * smallest_) smallest_ = distance, idle_ = 0;
  if (++idle_ > max_idle_iterations) return 0;
  return std::min(distance / enough_, own_step / (sufficient_decrease * distance));
}

void PenaltyRule::come_closer(double distance) { enough_ = sufficient_decrease * distance; }

double PenaltyRule::next(double distance) {
  const bool grows = distance > sufficient_decrease * left_;
  left_ = distance;
  ++idle_;
  if (!grows) return 1;
  stiffness_ *= penalty_growth;
  idle_ = 1;
  return penalty_growth;
}

}  // namespace tack
