// History variables of contact, other than those of bonds.
#pragma once

#include "framework/core/history.hpp"

namespace tack {

// Erases the secondary sides and the lagged weights: for positions that change outside a step.
void erase_contact_history(History& history);
// Erases the lagged weights alone (weight_relaxation.hpp).
void erase_lagged_weights(History& history);

}  // namespace tack
