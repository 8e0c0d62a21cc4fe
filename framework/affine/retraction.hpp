// Retraction of affine maps onto rotations. A linear change A + dA with a rotation by an angle w
// also strains by w^2 / 2, which a stiff body resists. A retracted change rotates without strain.
#pragma once

#include "geometry/types.hpp"

namespace tack {

// Retracts a change of A onto rotations. change: in, dA; out, the retracted change. Returns false,
// with dA unchanged, if A + dA is inverted.
//
// Polar decomposition: A = R S, dA = R (W S + D), W skew and D symmetric. The new map is
// R' (S + D), R' the rotation of A + dA, by less than half a turn. It agrees with A + dA to first
// order, and its strain is that of D alone.
bool retract_change(const Mat3& a, Mat3& change);

}  // namespace tack
