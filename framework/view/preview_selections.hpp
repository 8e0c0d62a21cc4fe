// What a scene selects of its objects, wherever it does: groups by name, and every `select` of a motion, load, pair, probe or interaction.
#pragma once

#include <string>
#include <vector>

#include "framework/config/value.hpp"
#include "framework/world/world.hpp"

namespace tack {

struct ShownSelection {
  std::string name;           // "cube: group top", "cube: motion 0 (fixed)", "probes lift to"
  std::vector<int> vertices;  // global, ascending
};

// Those that choose something, but not all of an object. `root`: the scene as parsed.
std::vector<ShownSelection> shown_selections(const Value& root, const World& world);

}  // namespace tack
