// What the terms of a potential are multiplied by: contact's (the dynamic terms) may differ from that of
// the others, since integrators treat its forces in their own way.
#pragma once

#include "framework/core/term.hpp"

namespace tack {

struct TermScales {
  double body = 1, contact = 1;
  double of(const Term& term) const { return term.dynamic() ? contact : body; }
};

}  // namespace tack
