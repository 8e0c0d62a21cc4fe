// Groups of bodies that may touch each other in the run, directly or through others
// (setup/loading.hpp finds them). Bodies of different groups change nothing for each other: no
// stiffness, no tolerance, no account of energy.
#pragma once

#include <utility>
#include <vector>

namespace tack {

struct MeetingGroups {
  std::vector<std::vector<int>> bodies;  // of each group, ascending; fixed bodies are in none
  // Fixed bodies that a motion moves, each with a body that it may touch.
  std::vector<std::pair<int, int>> pushed;
};

}  // namespace tack
