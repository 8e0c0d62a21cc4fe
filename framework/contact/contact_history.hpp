// History variables of contact from the step before, other than bonds.
#pragma once

#include "framework/core/history.hpp"

namespace tack {

// Erases which sides integrate and the shares of rods and particles: surfaces are put elsewhere, by
// no step.
void forget_contact_history(History& history);
void forget_shares(History& history);  // of these the shares alone (weight_relaxation.hpp)

}  // namespace tack
