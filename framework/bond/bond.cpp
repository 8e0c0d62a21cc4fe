#include "framework/bond/bond.hpp"

#include <Eigen/Geometry>

namespace tack {
namespace {

constexpr double normal_sum_min = 0.2;  // norm of the sum of two unit normals that have a mean direction

// Stores the unit normal and the barycentric gradients of a side's triangle at x. The triangle's
// vertices begin at bond.vertices[first].
void lag_side(Bond& bond, int side, int first, const VecX& x) {
  std::array<Vec3, 3> corner;
  for (int j = 0; j < 3; ++j) corner[j] = vertex(x, bond.vertices[first + j]);
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);  // twice the area
  const double twice = normal.norm();
  bond.normals[side] = bond.side[side] / twice * normal;
  for (int j = 0; j < 3; ++j)
    bond.gradients[first + j] = (normal / twice).cross(corner[(j + 2) % 3] - corner[(j + 1) % 3]) / twice;
}

}  // namespace

void lag_frame(Bond& bond, const VecX& x) {
  bond.gradients.fill(Vec3::Zero());
  lag_side(bond, 1, bond.site_count, x);
  bond.normal = bond.normals[0] = bond.normals[1];
  double length = 1;
  if (bond.site_count == 3) {
    lag_side(bond, 0, 0, x);
    const Vec3 sum = bond.normals[0] + bond.normals[1];
    if (const double norm = sum.norm(); norm > normal_sum_min) length = norm, bond.normal = sum / norm;
  }
  const Vec3& n = bond.normal;
  Vec3 r = -bond.lever[0] * bond.normals[0] - bond.lever[1] * bond.normals[1];
  for (int i = 0; i < bond.count(); ++i) r += bond.c[i] * vertex(x, bond.vertices[i]);
  const double along = n.dot(r);
  const Vec3 u = r - along * n;
  bond.turn = (along * (Mat3::Identity() - n * n.transpose()) - n * u.transpose()) / length;
}

}  // namespace tack
