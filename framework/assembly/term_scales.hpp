// Factors of the terms in a potential. The factor of dynamic terms (contact) may differ, because
// integrators treat contact forces differently.
#pragma once

#include "framework/core/term.hpp"

namespace tack {

/// Factors of static and of dynamic terms.
struct TermScales {
  double body = 1, contact = 1;
  double of(const Term& term) const { return term.dynamic() ? contact : body; }
};

}  // namespace tack
