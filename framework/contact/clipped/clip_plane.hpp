// Local coordinates of triangle b of a clipped pair (clipped_pair.hpp): origin at corner 0, axes
// along the first edge, across it, and along the normal. The lines of b run along its edges, from
// corner k to the next, with the inside on their left.
#pragma once

#include <array>

#include "geometry/types.hpp"

namespace tack {

class ClipPlane {
 public:
  struct Line {
    Vec2 begin;     // m
    Vec2 along;     // unit vector
    double length;  // m
    // Returns the distance of a point, positive inside [m].
    double distance(double x, double y) const {
      return along.x() * (y - begin.y()) - along.y() * (x - begin.x());
    }
    // Returns the position of the foot of a point, 0 at the begin, 1 at the end.
    double fraction(double x, double y) const {
      return (along.x() * (x - begin.x()) + along.y() * (y - begin.y())) / length;
    }
    Vec2 inward() const { return {-along.y(), along.x()}; }
  };

  // Takes the plane of the triangle b. Does nothing if it has it already.
  void set(const std::array<Vec3, 3>& b);

  Vec3 to_local(const Vec3& x) const { return axes.transpose() * (x - corners[0]); }
  // Returns the barycentric coordinates in b of a point of the plane.
  Vec3 shares(double x, double y) const {
    const double across = y / local[2].y(), along = (x - across * local[2].x()) / local[1].x();
    return {1 - along - across, along, across};
  }

  std::array<Vec3, 3> corners{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // m
  Mat3 axes = Mat3::Zero();  // columns; the last one is the normal
  double twice_area = 0;     // m^2; 0: a triangle without a plane
  std::array<Vec2, 3> local;
  std::array<Line, 3> lines;
};

}  // namespace tack
