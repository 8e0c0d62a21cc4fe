// Retraction of an affine map onto rotations. A linear change A + dA with a rotation by an angle w
// also strains by w^2 / 2, which a stiff body resists; a retracted change rotates without strain.
#pragma once

#include "geometry/types.hpp"

namespace tack {

// Polar decomposition: A = R S, dA = R (W S + D), W skew and D symmetric. The new map is R' (S +
// D), R' the rotation of A + dA, by less than half a turn. It agrees to first order, and all strain
// is that of D. change: in, dA; out, the change of A. Returns false, with dA unchanged, if A + dA
// is inverted.
bool bend_change(const Mat3& a, Mat3& change);

}  // namespace tack
