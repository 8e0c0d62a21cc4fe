// The state of a simulation between steps.
#pragma once

#include "geometry/types.hpp"

namespace tack {

struct State {
  double time = 0;  // s
  int step = 0;     // accepted steps
  VecX x, v, a;     // 3n: positions [m], velocities [m/s], accelerations [m/s^2]

  VecX anchor;          // 3n: where vertices were when they were last seized [m]; empty before the first step

  // The step before, for two-step integrators; valid while the step size stays the same.
  VecX x_before, v_before;
  double h_before = 0;  // s; 0: there is none
};

}  // namespace tack
