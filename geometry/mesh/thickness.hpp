// Thickness 2 V / A of a closed surface [m]: the thickness of a plate, half of that of a bar.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "geometry/types.hpp"

namespace tack {

class Thickness {
 public:
  // Adds a triangle of the surface, counter-clockwise from outside.
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
  std::optional<Vec3> origin_;    // reduces round-off far from the origin
  double volume_ = 0, area_ = 0;  // m^3, m^2
};

}  // namespace tack
