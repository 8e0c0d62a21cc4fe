// Loads that may press on bodies, estimated from the scene before it runs: the speed that something
// near a body may attain, and the weight that may lie on a body. Both belong to a meeting group:
// bodies that may touch each other in the run, directly or through others. Bodies outside the group
// do not affect it.
//
// Each body has a search box: its box at rest, inflated by a bound of its displacement,
//     R = max(diagonal, 2 (v T + g T^2 / 2)) + s.
// Factor 2: an elastic collision at most doubles a speed. v: largest initial speed in its group;
// T: duration of the run; s: largest displacement of a prescribed motion in its group.
// Bodies are of one group if their search boxes overlap, if they are attached, or if an interaction
// names them. Fixed bodies belong to no group: a common floor joins nothing. A body with loads, or
// in an interaction, may be driven anywhere.
//
// Groups depend on the duration: a longer run may join groups, and find another stiffness for them.
// summary.json and `tack check` name the groups. To compare runs of different durations, give
// contact.barrier.stiffness and body.stiffness.
// Limits: the bound is an estimate for defaults. Energy stored at the start, or a light mass hit by
// a heavier one, may carry a body farther.
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
  // Speed from the initial velocities in the group, and from a fall over the box of the group and
  // of the fixed bodies that it may meet [m/s].
  double speed = 0;
  double weight = 0;  // weight of all vertices in the group that are ever free [N]
};

// Returns the loading of the group of each body; 0 for fixed bodies.
std::vector<Loading> loadings(const SceneConfig& scene, const World& world, double duration);

// Returns the meeting groups.
MeetingGroups meeting_groups(const SceneConfig& scene, const World& world, double duration);

}  // namespace tack
