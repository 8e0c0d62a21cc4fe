// The state of a simulation between steps: all that the next step depends on. What solvers keep from
// step to step for speed (factors, candidates) is no part of it, and of influence on the last bits.
#pragma once

#include <vector>

#include "framework/core/energy_account.hpp"
#include "framework/core/history.hpp"
#include "geometry/types.hpp"

namespace tack {

struct State {
  double time = 0;  // s
  int step = 0;     // accepted steps
  // 3n: positions [m], velocities [m/s], accelerations [m/s^2]; no a: the state follows from no
  // step.
  VecX x, v, a;

  VecX anchor;          // 3n: where vertices were when they were last seized [m]; empty before the first step
  std::vector<char> held;  // per hold of the script: whether it acted in the step before

  // The step before, for two-step integrators; valid while the step size stays the same, or adapts.
  VecX x_before, v_before;
  double h_before = 0;  // s; 0: there is none
  double acted_before = 0;  // for how long contact and friction acted on velocities in it [s]; 0: not known

  // Accelerations by dynamic terms (Term::dynamic), now and in the step before (3n) [m/s^2]; empty:
  // not followed.
  VecX contact, contact_before;

  History history;

  EnergyAccount energy;

  int whole_steps = 0;  // steps of the scene's size behind us; a step in halves is one of them
  double h_next = 0;    // size tried next [s]; 0: the scene's
  int parts = 1;        // in which whole steps are begun, because larger ones made or lost energy; a power of two
  int calm_steps = 0;   // whole steps behind us since that number last changed

  // Of steps whose sizes follow an error (stepping/step_control.hpp).
  bool adapts = false;      // they are such steps: two-step integrators take other sizes behind them into account
  double error_before = 0;  // that of the last step, over what is allowed; 0: there is none
  double wary_until = 0;    // s: steps do not grow before
  double h_cap = 0;         // what larger steps made or lost energy beyond [s]; 0: nothing
};

}  // namespace tack
