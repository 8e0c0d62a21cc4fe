// What bodies may be pressed with, as far as a scene tells before it runs: the speed that something
// near them may reach, and the weight that may lie on them. Both belong to a meeting group: bodies
// that may touch each other in the run, directly or through others. What a body cannot meet changes
// nothing for it.
//
// Each body has a reach: the box around it at rest, inflated by how far it may go,
//     R = max(diagonal, 2 (v T + g T^2 / 2)) + s,
// v: the largest initial speed in its group, T: the duration of the run, s: the largest displacement
// of a prescribed motion in its group. Bodies whose reaches overlap, and those that are attached or
// that an interaction names, are of one group. Held bodies are of none: a common floor joins
// nothing. A body with loads, or in an interaction, may be driven anywhere.
// Limits: energy that is stored at the start and a mass that a heavier one throws may reach farther;
// it is an estimate for defaults.
#pragma once

#include <vector>

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// The first step and the duration of a run [s].
struct RunTimes {
  double step = 0, duration = 0;
};

struct Loading {
  // Of the initial velocities in the group, and of a fall over the box of it and of the held bodies
  // that it may meet [m/s].
  double speed = 0;
  double weight = 0;  // of all in the group that is ever free [N]
};

// Per body, that of its group; 0 of held ones.
std::vector<Loading> loadings(const SceneConfig& scene, const World& world, double duration);

}  // namespace tack
