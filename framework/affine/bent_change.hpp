// Changes of an affine map that turn it. A straight one, A + dA, that turns by an angle w strains by w^2 / 2 as well, which
// a stiff body hardly allows; bent ones turn as far as they like.
#pragma once

#include "geometry/types.hpp"

namespace tack {

// With the polar decomposition A = R S and dA = R (W S + D), W skew and D symmetric, A goes to R' (S + D), where R' is the
// rotation of A + dA, by less than half a turn: the same to first order, and all strain is D's.
// change: in, dA; out, what A changes by. False, and as it was, where A + dA is turned inside out.
bool bend_change(const Mat3& a, Mat3& change);

}  // namespace tack
