// Extent of a body.
#pragma once

#include <Eigen/Geometry>

#include "framework/body/body.hpp"

namespace tack {

// Returns the AABB of the mesh vertices of a body at x (3n) [m].
inline Eigen::AlignedBox3d extent_of(const Body& body, const VecX& x) {
  Eigen::AlignedBox3d box;
  for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v)
    box.extend(Vec3(vertex(x, v)));
  return box;
}

}  // namespace tack
