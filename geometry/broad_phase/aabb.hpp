// Axis-aligned bounding box [lo, hi] in metres; empty (lo > hi) by default. Boxes are closed: two
// boxes that touch overlap.
#pragma once

#include <limits>

#include "geometry/types.hpp"

namespace tack {

struct Aabb {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 hi = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void include(const Vec3& point) {
    lo = lo.cwiseMin(point);
    hi = hi.cwiseMax(point);
  }
  void include(const Aabb& other) {
    lo = lo.cwiseMin(other.lo);
    hi = hi.cwiseMax(other.hi);
  }
  void inflate(double by) {
    lo.array() -= by;
    hi.array() += by;
  }
  bool contains(const Vec3& point) const {
    return (lo.array() <= point.array()).all() && (point.array() <= hi.array()).all();
  }
  bool overlaps(const Aabb& other) const {
    return (lo.array() <= other.hi.array()).all() && (other.lo.array() <= hi.array()).all();
  }
  // Half the surface area [m^2]; 0 for an empty box.
  double half_area() const {
    const Vec3 side = (hi - lo).cwiseMax(0.0);
    return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
  }
};

}  // namespace tack
