// A pair of objects (or one with itself) cut out of a world and brought into contact alone, as at the end of a step:
// what its search, its collision detection and its stencils take is measured, and thrown away. Nothing of the world
// is touched.
#pragma once

#include <array>

#include "framework/core/term_times.hpp"
#include "framework/profile/pair_counts.hpp"
#include "framework/world/world.hpp"

namespace tack {

// What contact takes in a run or in a part of it [s].
struct ContactSeconds {
  double broad_phase = 0, narrow_phase = 0, ccd = 0;
  std::array<double, evaluation_count> normal{}, friction{};  // the stencils: value, gradient, Hessian

  // Calls act(part of first, the same part of second) for each part.
  template <class First, class Second, class Act>
  static void for_each(First& first, Second& second, const Act& act) {
    act(first.broad_phase, second.broad_phase);
    act(first.narrow_phase, second.narrow_phase);
    act(first.ccd, second.ccd);
    for (int i = 0; i < evaluation_count; ++i) {
      act(first.normal[i], second.normal[i]);
      act(first.friction[i], second.friction[i]);
    }
  }
  double normal_stencils() const;
  double friction_stencils() const;
  double total() const;
};

struct IsolatedPair {
  PairCount count;         // as at the end of the step
  ContactSeconds seconds;  // of one start of a step, the searches, one way to its end and one evaluation of each kind
};

// `state`: after a step.
IsolatedPair isolate(const World& world, ObjectIds pair, const State& state);

}  // namespace tack
