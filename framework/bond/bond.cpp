#include "framework/bond/bond.hpp"

#include <Eigen/Geometry>

namespace tack {

void hold_frame(Bond& bond, const VecX& x) {
  std::array<Vec3, 3> corner;
  for (int j = 0; j < 3; ++j) corner[j] = vertex(x, bond.vertices[bond.leading + j]);
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);  // twice the area
  const double twice = normal.norm();
  bond.normal = bond.side / twice * normal;
  Vec3 r = Vec3::Zero();
  for (int i = 0; i < bond.count(); ++i) r += bond.c[i] * vertex(x, bond.vertices[i]);
  const double along = bond.normal.dot(r);
  const Vec3 u = r - along * bond.normal;
  bond.shift.setZero();
  for (int j = 0; j < 3; ++j) {
    const Vec3 g = (normal / twice).cross(corner[(j + 2) % 3] - corner[(j + 1) % 3]) / twice;  // of corner j's coordinate
    bond.turns[j] = along * g - u.dot(g) * bond.normal;
    bond.shift -= bond.turns[j] * bond.normal.dot(corner[j]);
  }
}

}  // namespace tack
