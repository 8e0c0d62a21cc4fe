#include "framework/contact/clipped/close_triangles.hpp"

#include <Eigen/Geometry>

#include <algorithm>

#include "framework/contact/clipped/clipped_pair.hpp"

namespace tack {
namespace {

// Returns a bound of the change of the unit normal of a triangle: of u = v / |v|, by a change of v of
// length d it is 2 d / (2 |v| - d) at most.
double turn_of(const std::array<Vec3, 3>& x, double twice_area, double motion) {
  const double edges = (x[1] - x[0]).norm() + (x[2] - x[0]).norm(), change = 2 * motion * edges + 4 * motion * motion;
  return change < twice_area ? 2 * change / (2 * twice_area - change) : 2;
}

}  // namespace

bool CloseTriangles::may_overlap(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double range, bool two_sided) {
  if (plane_.corners != b) {
    plane_.set(b);
    turn_b_ = turn_of(b, plane_.twice_area, motion_);
  }
  if (!(plane_.twice_area > 0)) return true;
  const double slack = 2 * motion_ + range * turn_b_;
  std::array<Vec3, 3> local;
  for (int k = 0; k < 3; ++k) local[k] = plane_.to_local(a[k]);
  const double low = std::min({local[0].z(), local[1].z(), local[2].z()}), high = std::max({local[0].z(), local[1].z(), local[2].z()});
  if (low > range + slack || high < -slack - (two_sided ? range : 0)) return false;
  // Two triangles of a plane are apart by more than the slack if one of their lines separates them so.
  for (const ClipPlane::Line& line : plane_.lines)
    if (std::max({line.distance(local[0].x(), local[0].y()), line.distance(local[1].x(), local[1].y()), line.distance(local[2].x(), local[2].y())}) < -slack)
      return false;
  for (int k = 0; k < 3; ++k) {
    const Vec2 from = local[k].head<2>(), edge = local[(k + 1) % 3].head<2>() - from, across(-edge.y(), edge.x());
    // Extents across the edge, times its length.
    const double own = across.dot(local[(k + 2) % 3].head<2>() - from), margin = slack * edge.norm();
    double least = 1e300, largest = -1e300;
    for (const Vec2& corner : plane_.local) {
      const double at = across.dot(corner - from);
      least = std::min(least, at);
      largest = std::max(largest, at);
    }
    if (least > std::max(own, 0.0) + margin || largest < std::min(own, 0.0) - margin) return false;
  }
  if (two_sided) return true;
  const Vec3 cross_a = (a[1] - a[0]).cross(a[2] - a[0]);
  const double facing = -cross_a.dot(plane_.axes.col(2)), twice_area_a = cross_a.norm();
  return facing >= (clip_cosine_min - turn_of(a, twice_area_a, motion_) - turn_b_) * twice_area_a;
}

}  // namespace tack
