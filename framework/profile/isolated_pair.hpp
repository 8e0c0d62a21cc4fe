// Pair of objects (or one object with itself) cut out of a world, in contact alone at the end of a
// step. Its search, collision detection and stencils are timed and discarded. The world is
// unchanged.
#pragma once

#include <array>

#include "framework/core/term_times.hpp"
#include "framework/profile/pair_counts.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Times of contact in a run or a phase of it [s].
struct ContactSeconds {
  double broad_phase = 0, narrow_phase = 0, ccd = 0;
  std::array<double, evaluation_count> normal{},
      friction{};  // the stencils: value, gradient, Hessian

  // Calls act(member of first, equal member of second) for each time.
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
  ContactSeconds seconds;  // of one start of a step, the searches, one path to its end and one
                           // evaluation of each kind
};

// `state`: after a step.
IsolatedPair isolate(const World& world, ObjectIds pair, const State& state);

}  // namespace tack
