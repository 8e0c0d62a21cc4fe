// Selections of a scene: groups by name, and every `select` of a motion, load, pair, probe or
// interaction.
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

// Returns selections that contain some but not all vertices of an object. root: the parsed scene.
std::vector<ShownSelection> shown_selections(const Value& root, const World& world);

}  // namespace tack
