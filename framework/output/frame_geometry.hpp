// Cells of a world's frames.
#pragma once

#include "framework/output/vtu.hpp"

namespace tack {

struct World;

FrameGeometry frame_geometry(const World& world);

}  // namespace tack
