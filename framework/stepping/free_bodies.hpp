// Bodies that nothing holds in a step without inertia: rigid modes without stiffness, and a force
// along one of them. There is no equilibrium then, and a minimiser would go on along the mode for
// ever. A contact group (force_groups.hpp) is free where no element, joint or contact force of it
// ends at a held vertex, the forces on it do not balance, and no other body lies in the direction
// of their sum, which could stop it. Torques alone are not looked at: what they turn may come to
// rest.
#pragma once

#include <stdexcept>
#include <string>

#include "framework/stepping/force_groups.hpp"

namespace tack {

struct FreeBody : std::runtime_error {
  using std::runtime_error::runtime_error;
  static constexpr const char* remedy =
      "hold it (motion, attach), let contact reach it, make its adhesion stronger than what pulls, or take "
      "an integrator with inertia (time.integrator: implicit_euler)";
};

// Throws FreeBody, with its name and the force, if a group of blocks at x (3n) is free. gradient:
// of the potential, over the unknowns [N]; the groups have been measured there.
void check_free_bodies(const World& world, const ForceGroups& groups, const VecX& x,
                       const VecX& gradient);

}  // namespace tack
