// Whether a law of bonds is what a step takes it for: a potential with the derivatives that it states, of which what a step takes is stored or
// dissipated, with the peak and the work that it states.
#pragma once

#include "framework/bond/bond_law.hpp"
#include "framework/checks/law_check.hpp"

namespace tack {

// Prepared. The lines begin with its name.
LawCheck check_law(const BondLaw& law);

}  // namespace tack
