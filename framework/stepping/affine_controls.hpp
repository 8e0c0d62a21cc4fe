// Control vertices of vertices that move affinely, e.g. rigidly: up to four of them, which span the
// others. All others depend on them with constant weights,
//     x_v = sum_k w_k x_k,   sum_k w_k = 1,
// so that at most 12 unknowns move all of them.
#pragma once

#include <optional>
#include <span>

#include "framework/core/dependence.hpp"
#include "geometry/types.hpp"

namespace tack {

// Returns the dependences of all other vertices on the control vertices at x (3n) [m].
Dependences affine_dependences(std::span<const int> vertices, const VecX& x);

// Returns whether the dependences hold at x (3n) but for round-off: 1e-9 of the distances between
// the control vertices.
bool hold(const Dependences& dependences, const VecX& x);

}  // namespace tack
