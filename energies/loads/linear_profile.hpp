// Profile of a load in time and space.
#pragma once

#include <cmath>

#include "framework/config/field.hpp"

namespace tack {

// factor(X, t) = ramp(t) (constant + slope s), s = axis . (X - centre) at rest, or |s| if
// symmetric.
struct LoadProfile {
  Schedule ramp = 1.0;
  double constant = 1;
  double slope = 0;  // 1/m
  Vec3 axis = Vec3::UnitX();
  Vec3 centre = Vec3::Zero();  // m
  bool symmetric = false;
  std::string drive;  // of a protocol: a further factor (world/load_terms.hpp); empty: none

  void fields(Fields& f) {
    f.schedule("ramp", ramp, units::none, "factor over time: a number or [[t, factor], ...]");
    f.number("constant", constant, units::none, "uniform term of the load");
    f.number("slope", slope, units::curvature, "slope of the linear term along the axis");
    f.vector("axis", axis, units::none, "direction of the linear term");
    f.vector("centre", centre, units::length, "point at which the linear term is zero");
    f.flag("symmetric", symmetric,
           "the linear term grows with the distance from the centre on both sides");
    f.text("drive", drive,
           "drive of a protocol: a further factor over time, 0 until a stage sets it")
        .line();
    f.check("axis", [this]() -> std::string { return axis.norm() > 0 ? "" : "must not be zero"; });
  }

  std::vector<double> corners() const { return ramp.corners(); }

  double at(const Vec3& rest_position, double t) const {
    const double along = axis.normalized().dot(rest_position - centre);
    return ramp.at(t) * (constant + slope * (symmetric ? std::abs(along) : along));
  }
};

}  // namespace tack
