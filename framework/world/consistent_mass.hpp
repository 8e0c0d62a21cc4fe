// The mass matrix W^T M W of unknowns that move several vertices each. It is not diagonal if affine
// bodies are joined.
#pragma once

#include "framework/core/dof_map.hpp"

namespace tack {

// Returns (W^T M W)^-1 f in the free directions; zero in blocks without mass. mass: n [kg]; f: by
// unknowns (3m).
VecX divide_by_mass(const DofMap& dofs, const VecX& mass, const VecX& f);
// Replaces v (3n) [m/s] by the nearest velocities, in kinetic energy, that the unknowns can have:
// the velocities after an impact of constraints and joints.
void make_possible(const DofMap& dofs, const VecX& mass, VecX& v);

}  // namespace tack
