// Tunnelling check of a step. Every iterate of a minimisation is free of intersections, but the
// path of the minimiser is not a trajectory: in a large step a body can be minimised around an
// obstacle that it should have hit. Therefore accepted steps are checked along linear trajectories
// from start to end.
//
// Two connected components are checked if their relative displacement (moving_components.hpp)
// exceeds half the size of the smaller one. They tunnel if continuous collision detection finds a
// hit and their relative displacement after the hit exceeds that length too. Limitation: smaller
// displacements, and components that deform as far as they move, are not checked, because sliding,
// rolling and wrapping have curved trajectories.
#pragma once

#include <memory>
#include <optional>

#include "framework/stepping/moving_components.hpp"

namespace tack {

class CandidateFinder;

struct Tunnelling {
  int body = 0, obstacle = 0;  // of the world; the body is the one that moved farther
  double displacement = 0;     // relative displacement [m]
  double size = 0;             // of the smaller component [m]
  // Number of substeps, a power of two, for which none is longer than half of that size.
  int substeps = 2;
};

class TunnellingCheck {
 public:
  // Largest relative displacement that is not checked, over the size of the smaller component.
  static constexpr double tolerated = 0.5;

  // The world must have contact.
  explicit TunnellingCheck(const World& world);
  ~TunnellingCheck();

  // Returns the first tunnelling pair from x to y (3n), if any. Both must be free of intersections.
  std::optional<Tunnelling> find(const VecX& x, const VecX& y);

 private:
  struct Search;
  std::optional<std::array<int, 2>> find_components(const VecX& x, const VecX& y,
                                                    const std::vector<std::array<int, 2>>& pairs);

  const World& world_;
  MovingComponents components_;
  std::unique_ptr<CandidateFinder> finder_;  // null until first needed
};

}  // namespace tack
