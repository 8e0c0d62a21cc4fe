// What bonds are like at the vertices that they hang on, on either side.
#pragma once

#include "framework/scene/world.hpp"

namespace tack {

// Their mean intensity, by area; not a number where there is none.
VecX bond_intensities(const World& world);
// The magnitude of their force per area [Pa]; 0 where there is none.
VecX bond_tractions(const World& world, const VecX& x);

}  // namespace tack
