// Growth of the strength of bonds while surfaces are pressed together.
#pragma once

#include "framework/law/bond_study.hpp"

namespace tack {

// Appends the healing of bonds that form on contact, at 0.1, 1 and 10 times the pressure [Pa], for
// bonds that are then opened to `opening_end` [m]. Appends nothing if the bonds do not heal.
void study_healing(const BondLaw& law, double pressure, double opening_end,
                   std::vector<HealingCurve>& curves, std::vector<KeyQuantity>& quantities);

}  // namespace tack
