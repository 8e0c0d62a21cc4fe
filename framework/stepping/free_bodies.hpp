// Bodies that nothing holds in a step without inertia: rigid modes without stiffness, and a force
// along one of them. There is no equilibrium then, and a minimiser would go on along the mode for
// ever. Each contact group (force_groups.hpp) is examined alone:
//   - Free translations are all, where no element, joint or contact force of the group ends at a
//     held vertex; without those directions in which vertices of the group are held.
//   - The group is free if the forces on it do not balance along its free translations, and no
//     other body lies in the direction of their sum, which could stop it.
//   - A group that nothing holds at all may also turn. A torque whose forces balance is no error,
//     as the group may come to rest where it has turned to; `tack check` warns of it.
#pragma once

#include <stdexcept>
#include <vector>

#include "framework/core/warning.hpp"
#include "framework/stepping/force_groups.hpp"

namespace tack {

struct FreeBody : std::runtime_error {
  using std::runtime_error::runtime_error;
  static constexpr const char* remedy =
      "hold it (motion, attach), let contact reach it, make its adhesion stronger than what pulls, "
      "or take "
      "an integrator with inertia (time.integrator: implicit_euler)";
};

// Throws FreeBody, with its name and the force, if a group of blocks at x (3n) is free. gradient:
// of the potential, over the unknowns [N]; the groups have been measured there.
void check_free_bodies(const World& world, const ForceGroups& groups, const VecX& x,
                       const VecX& gradient);

// Returns a line for each group that nothing holds and that a torque turns, though the forces on it
// balance. Arguments as above.
std::vector<Warning> turning_bodies(const World& world, const ForceGroups& groups,
                                        const VecX& x, const VecX& gradient);

}  // namespace tack
