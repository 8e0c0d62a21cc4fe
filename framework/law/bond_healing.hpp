// Growth of the strength of bonds while surfaces are pressed together.
#pragma once

#include "framework/law/bond_study.hpp"

namespace tack {

// Appends the healing of bonds that form on contact, at 0.1, 1 and 10 times the pressure [Pa], for
// bonds that part over `far` [m]. Appends nothing if the bonds do not heal.
void study_healing(const BondLaw& law, double pressure, double far,
                   std::vector<HealingCurve>& curves, std::vector<LawFigure>& figures);

}  // namespace tack
