// Positions of prescribed vertices over time; other vertices keep their initial positions.
#pragma once

#include <string>
#include <vector>

#include "framework/world/world.hpp"

namespace tack {

struct PrescribedFrames {
  std::vector<double> times;    // s
  std::vector<VecX> positions;  // 3n each [m]
  std::string problem;          // reason why frames end early; empty: they do not
};

// Returns `frames` frames evenly spread over the duration [s], or the start alone if nothing is
// prescribed. Vertices that depend on prescribed ones move with them.
PrescribedFrames prescribed_frames(const World& world, double duration, int frames);

}  // namespace tack
