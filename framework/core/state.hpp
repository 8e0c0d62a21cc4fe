// State of a simulation between steps: everything that the next step depends on. Caches of solvers
// (factors, candidates) are not part of the state; they influence the last bits only.
#pragma once

#include <vector>

#include "framework/core/energy_account.hpp"
#include "framework/core/history.hpp"
#include "geometry/types.hpp"

namespace tack {

/// State of the step size controller between two steps (stepping/step_size.hpp).
struct StepSizeState {
  double h_next = 0;           // size of the next step [s]; 0: the scene's
  double h_max = 0;            // size above which steps gained or lost energy [s]; 0: none
  int steady_steps = 0;        // whole or adaptive steps since `h_max` last changed
  double error_before = 0;     // error of the last adaptive step over its tolerance; 0: none
  double no_growth_until = 0;  // time before which adaptive steps do not grow [s]
};

/// Positions, velocities, history variables and step size control between two steps.
struct State {
  double time = 0;  // s
  int step = 0;     // accepted steps
  // 3n: positions [m], velocities [m/s], accelerations [m/s^2]. a is empty before the first step.
  VecX x, v, a;

  // 3n: reference positions of prescribed motions: the positions at their last start [m]; empty
  // before the first step.
  VecX x_motion_start;
  std::vector<char> motion_active;  // per prescribed motion: active in the last step

  // The step before, for two-step integrators; valid while the step size stays the same, or adapts.
  VecX x_before, v_before;
  double h_before = 0;             // s; 0: there is none
  bool adapts = false;             // step sizes follow an error: they vary from step to step
  double contact_time_before = 0;  // time in which contact acted in it [s]; 0: unknown

  // Accelerations by dynamic terms (Term::dynamic), now and in the step before (3n) [m/s^2]; empty:
  // not followed.
  VecX contact, contact_before;

  History history;

  EnergyAccount energy;

  StepSizeState step_size;
};

}  // namespace tack
