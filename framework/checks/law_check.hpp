// Check of contact laws against the assumptions of contact: functions that end smoothly at their
// range, with the stated derivatives and totals, and a peak that surfaces can feel.
#pragma once

#include <string>
#include <vector>

#include "framework/contact/laws/pair_law.hpp"
#include "framework/core/warning.hpp"

namespace tack {

struct World;

struct LawCheck {
  std::vector<Warning> errors;     // derivatives that contradict the values
  std::vector<std::string> notes;  // remarks of the laws themselves
  std::vector<Warning> warnings;   // usable, but not as the law promises
};

// Checks one law over its whole range. The lines begin with its name.
LawCheck check_law(const NormalLaw& law);

// Checks the laws of a pair, and whether the barrier lets surfaces feel the peak of the adhesion.
LawCheck check_pair(const PairLaw& pair);

// Checks all laws of adhesive pairs, by the first pair of each kind.
LawCheck check_laws(const World& world);

}  // namespace tack
