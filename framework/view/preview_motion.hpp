// Where the motions of a scene have what they hold, as time goes on; all else stays where it starts.
#pragma once

#include <string>
#include <vector>

#include "framework/world/world.hpp"

namespace tack {

struct ScriptedFrames {
  std::vector<double> times;  // s
  std::vector<VecX> places;   // 3n each [m]
  std::string problem;        // why they end early; empty: they do not
};

// So many evenly spread over the duration [s], or the start alone if nothing is moved. What follows what is held goes along with it.
ScriptedFrames scripted_frames(const World& world, double duration, int frames);

}  // namespace tack
