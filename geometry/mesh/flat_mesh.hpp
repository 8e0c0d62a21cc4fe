// Triangles in the plane, counter-clockwise. Metres.
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct FlatMesh {
  std::vector<Vec2> vertices;
  std::vector<Triangle> triangles;
};

}  // namespace tack
