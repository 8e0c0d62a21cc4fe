// Whether the straight ways of a step are free. No state on the way of a minimiser intersects, but its way is no trajectory: what moves
// by more than its own size in a step may have been led around an obstacle that it should have hit. So where two parts moved,
// as wholes, against each other by more than half the smaller one's size, continuous collision detection looks along the straight
// way from where the step starts to where it ends. What it meets is passed if the parts have moved on by more than that from there. Smaller
// ways are not looked at, nor what deforms as far as it moves: whoever slides, rolls, or is wrapped, does so on ways that are bent.
#pragma once

#include <memory>
#include <optional>

#include "framework/stepping/moving_parts.hpp"

namespace tack {

class CandidateFinder;

struct BlockedWay {
  int body = 0, obstacle = 0;  // of the world; the body is the one that moved further
  double way = 0;              // of the one against the other [m]
  double size = 0;             // of the smaller one [m]
  // Into how many parts the step must be cut so that none of them is longer than half of that; a power of two.
  int parts = 2;
};

class StraightWays {
 public:
  static constexpr double tolerated = 0.5;   // of the smaller one's size

  // The world must have contact.
  explicit StraightWays(const World& world);
  ~StraightWays();

  // Nothing if those from x to y (3n) are free. Both must be free of intersection.
  std::optional<BlockedWay> blocked(const VecX& x, const VecX& y);

 private:
  struct Search;
  std::optional<std::array<int, 2>> blocked_parts(const VecX& x, const VecX& y, const std::vector<std::array<int, 2>>& pairs);

  const World& world_;
  MovingParts parts_;
  std::unique_ptr<CandidateFinder> finder_;  // made when something may be passed
};

}  // namespace tack
