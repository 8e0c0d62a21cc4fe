// Accelerations that no step has computed: of initial states, of released vertices, and by dynamic
// terms.
#pragma once

#include <vector>

#include "framework/stepping/time_integrator.hpp"
#include "framework/world/step_potential.hpp"

namespace tack {

class Accelerations {
 public:
  // step: a usual size of steps [s].
  Accelerations(World& world, const TimeIntegrator& integrator, double step);

  // Sets the accelerations of vertices at time t [s] to M^-1 times the forces, for the step of
  // Newmark and the first guess.
  void set(State& state, double t, const std::vector<int>& vertices, StepPotential& potential);
  // Returns the accelerations of all moving vertices by the dynamic terms at x (3n): the next value
  // of State::contact. Empty if the integrator does not use it. Moves the terms to x.
  VecX by_dynamic_terms(const VecX& x) const;

 private:
  VecX by(const VecX& force) const;
  VecX dynamic(const VecX& x) const;

  World& world_;
  const TimeIntegrator& integrator_;
  double step_;
  std::vector<const Term*> dynamic_terms_;  // empty if the integrator does not use their forces
};

}  // namespace tack
