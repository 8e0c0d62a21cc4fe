// Groups of bodies that may touch each other in the run, directly or through other bodies
// (setup/loading.hpp finds them). Bodies of different groups do not interact: computed stiffness,
// tolerances and energy accounts belong to one group.
#pragma once

#include <utility>
#include <vector>

namespace tack {

struct MeetingGroups {
  std::vector<std::vector<int>> bodies;  // per group, ascending; without fixed bodies
  // Fixed bodies that a motion moves, each with a body that it may touch.
  std::vector<std::pair<int, int>> pushed;
};

}  // namespace tack
