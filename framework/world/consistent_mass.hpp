// The mass matrix of unknowns that move several vertices each, W^T M W: not diagonal, as soon as affine bodies are joined.
#pragma once

#include "framework/core/dof_map.hpp"

namespace tack {

// (W^T M W)^-1 f in the directions that are free; blocks that move no mass get zero. mass: n [kg]; f: of the unknowns (3m).
VecX divide_by_mass(const DofMap& dofs, const VecX& mass, const VecX& f);
// The velocities (3n) [m/s] next to v, in kinetic energy, that the unknowns can have: what a sudden blow by what holds and joins leaves of them.
void make_possible(const DofMap& dofs, const VecX& mass, VecX& v);

}  // namespace tack
