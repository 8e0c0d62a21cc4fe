// History variables of contact, other than those of bonds: arrays with names "contact/...". Those
// of bonds are "contact/bonds...".
#pragma once

#include <map>

#include "framework/core/history.hpp"

namespace tack {

// Erases the history of contact models: for positions that change outside a step.
inline void erase_contact_history(History& history) {
  std::erase_if(history, [](const auto& array) {
    return array.first.starts_with("contact/") && !array.first.starts_with("contact/bonds");
  });
}

}  // namespace tack
