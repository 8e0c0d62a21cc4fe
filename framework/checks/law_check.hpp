// Whether the laws of a scene's contact are what contact takes them for: functions that end smoothly at their range, with the derivatives
// and totals that they state, and a peak that surfaces can feel.
#pragma once

#include <string>
#include <vector>

#include "framework/contact/pair_law.hpp"

namespace tack {

struct World;

struct LawCheck {
  std::vector<std::string> wrong;     // derivatives that are not those of the values
  std::vector<std::string> notes;     // what laws say of themselves
  std::vector<std::string> doubtful;  // what a simulation can go on with, but does not give what the law promises
};

// Of one law by itself, over its whole range. The lines begin with its name.
LawCheck check_law(const NormalLaw& law);

// Of those of a pair, and whether the barrier lets surfaces feel the peak of the adhesion.
LawCheck check_pair(const PairLaw& pair);

// Of all laws of adhesive pairs, of the first pair of each kind.
LawCheck check_laws(const World& world);

}  // namespace tack
