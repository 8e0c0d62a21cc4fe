// Free bodies of a step without inertia: rigid modes without stiffness, with a force along one of
// them. There is no equilibrium then, and a minimiser would move along the mode without end. Each
// contact group (force_groups.hpp) is examined alone:
//   - Translations of a group are free if no element, joint or contact force of the group acts at a
//     fixed vertex. Fixed directions of its vertices are not free.
//   - The group is free if the forces on it do not balance along its free translations, and no
//     other body that could stop it lies in the direction of their sum.
//   - A group without any fixed vertex may also rotate. A torque whose forces balance is no error,
//     because the group may come to rest in its new orientation; `tack check` warns of it.
#pragma once

#include <stdexcept>
#include <vector>

#include "framework/core/warning.hpp"
#include "framework/stepping/force_groups.hpp"

namespace tack {

struct FreeBody : std::runtime_error {
  using std::runtime_error::runtime_error;
  static constexpr const char* remedy =
      "fix it (motion, attach), bring it into contact, make its adhesion stronger than the load, "
      "or take an integrator with inertia (time.integrator: implicit_euler)";
};

// Throws FreeBody, with the name of a body and the force, if a contact group at x (3n) is free.
// gradient: of the potential, by the unknowns [N]. The groups must be measured at x.
void check_free_bodies(const World& world, const ForceGroups& groups, const VecX& x,
                       const VecX& gradient);

// Returns a warning for each group without fixed vertices on which a torque acts, although the
// forces on it balance. Arguments as above.
std::vector<Warning> turning_bodies(const World& world, const ForceGroups& groups, const VecX& x,
                                    const VecX& gradient);

}  // namespace tack
