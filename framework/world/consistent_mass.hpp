// The mass matrix W^T M W of unknowns that move several vertices each. It is not diagonal if affine
// bodies are joined.
#pragma once

#include "framework/core/dof_map.hpp"

namespace tack {

// Returns (W^T M W)^-1 f in the free directions; zero in blocks without mass. mass: n [kg]; f: by
// unknowns (3m).
VecX divide_by_mass(const DofMap& dofs, const VecX& mass, const VecX& f);
// Projects v (3n) [m/s] onto the velocities that the unknowns can have. The projection is
// orthogonal in kinetic energy: the result is the velocity after an impact of constraints and
// joints.
void project_velocities(const DofMap& dofs, const VecX& mass, VecX& v);

}  // namespace tack
