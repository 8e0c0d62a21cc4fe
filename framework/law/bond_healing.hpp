// How the strength of bonds grows while surfaces are pressed together.
#pragma once

#include "framework/law/bond_study.hpp"

namespace tack {

// Of bonds that are made on contact, under a tenth of the pressure, the pressure [Pa] and ten times that; of what parts over `far` [m]. Nothing
// if they do not heal.
void study_healing(const BondLaw& law, double pressure, double far, std::vector<HealingCurve>& curves, std::vector<LawFigure>& figures);

}  // namespace tack
