// What the balance of energy carries from step to step (energy_balance.hpp).
#pragma once

#include "framework/core/energy_at_play.hpp"
#include "geometry/types.hpp"

namespace tack {

struct EnergyAccount {
  bool open = false;  // false: nothing is known of the state's energies yet
  // Of the state, of all that was free in the step before [J].
  double kinetic = 0, gravity = 0, elastic = 0, contact = 0;
  double friction = 0, plastic = 0, damping = 0;  // dissipated so far; friction with tangential adhesion [J]
  VecX gradient;  // 3n: of elastic and contact energy [N]; empty if no script moves anything

  double unexplained = 0;  // energy that nothing put in, from the first step on [J]
  double lowest = 0;       // its smallest value since the last gain that was told of [J]
  EnergyAtPlay at_play;    // so far
  double bottom = 0;       // the smallest value of all of `unexplained` [J]
  int grown_steps = 0;     // steps behind us in all of which it was far above that
  bool told = false;       // that it was for long
};

}  // namespace tack
