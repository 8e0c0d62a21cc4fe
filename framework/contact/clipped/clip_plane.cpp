#include "framework/contact/clipped/clip_plane.hpp"

#include <Eigen/Geometry>

namespace tack {

void ClipPlane::set(const std::array<Vec3, 3>& b) {
  if (b == corners) return;
  corners = b;
  const Vec3 first = b[1] - b[0], second = b[2] - b[0], cross = first.cross(second);
  twice_area = cross.norm();
  if (!(twice_area > 0)) return;
  const double length = first.norm();
  axes.col(0) = first / length;
  axes.col(2) = cross / twice_area;
  axes.col(1) = axes.col(2).cross(axes.col(0));
  local = {Vec2(0, 0), Vec2(length, 0), Vec2(axes.col(0).dot(second), twice_area / length)};
  for (int k = 0; k < 3; ++k) {
    const Vec2 edge = local[(k + 1) % 3] - local[k];
    const double size = edge.norm();
    lines[k] = {local[k], edge / size, size};
  }
}

}  // namespace tack
