// Check of a bond law against the assumptions of a step: it is a potential with the derivatives
// that it states; a step stores or dissipates all energy that it takes; peak and work are as
// stated.
#pragma once

#include "framework/bond/bond_law.hpp"
#include "framework/checks/law_check.hpp"

namespace tack {

// Checks a law that is prepared. The lines begin with the name of the law.
LawCheck check_law(const BondLaw& law);

}  // namespace tack
