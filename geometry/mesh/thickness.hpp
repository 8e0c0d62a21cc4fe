// 2 V / A of a closed surface [m]: the thickness of a plate, half that of a bar.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "geometry/types.hpp"

namespace tack {

class Thickness {
 public:
  // A triangle of the surface, seen counter-clockwise from outside.
  void add(const std::array<Vec3, 3>& corners) {
    const auto& [a, b, c] = corners;
    if (!origin_) origin_ = a;
    const Vec3 twice = (b - a).cross(c - a);
    volume_ += (a - *origin_).dot(twice) / 6;
    area_ += twice.norm() / 2;
  }

  double area() const { return area_; }  // m^2
  double thickness() const { return area_ > 0 ? 2 * volume_ / area_ : 0; }

 private:
  std::optional<Vec3> origin_;  // what is far from the coordinates' origin would lose its digits
  double volume_ = 0, area_ = 0;  // m^3, m^2
};

}  // namespace tack
