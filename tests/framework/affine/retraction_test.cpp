#include "framework/affine/retraction.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <catch2/catch.hpp>

using namespace tack;

namespace {

Mat3 turned(double angle, const Vec3& axis) { return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(); }

double strain(const Mat3& a) { return 0.5 * (a.transpose() * a - Mat3::Identity()).norm(); }

Mat3 skew(const Vec3& w) {
  Mat3 m;
  m << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return m;
}

const Vec3 spin(0.3, -0.5, 0.4);

}  // namespace

TEST_CASE("a retracted rotation is free of strain for any angle", "[affine]") {
  const Mat3 a = turned(1, {1, 2, 3});
  for (const double t : {1e-3, 1.0, 100.0}) {
    const Mat3 straight = t * skew(spin) * a;
    Mat3 change = straight;
    REQUIRE(retract_change(a, change));
    CHECK(strain(a + change) < 1e-11);
    CHECK(strain(a + straight) > 0.4 * t * t * spin.squaredNorm());
    // The rotation is about the axis of the spin, by the arctangent of its angle.
    const Eigen::AngleAxisd turn(Mat3((a + change) * a.transpose()));
    CHECK((turn.axis() - spin.normalized()).norm() < 1e-9);
    CHECK(turn.angle() == Approx(std::atan(t * spin.norm())).epsilon(1e-9));
  }
}

TEST_CASE("a retracted change agrees with the linear one to first order, also for a strained map", "[affine]") {
  Mat3 stretch;
  stretch << 1.2, 0.1, 0, 0.1, 0.9, -0.05, 0, -0.05, 1.1;
  const Mat3 a = turned(2, {3, 1, -1}) * stretch;
  Mat3 rate;
  rate << 0.3, 0.7, -0.2, -0.4, 0.1, 0.6, 0.5, -0.8, -0.1;
  for (const double t : {1e-2, 1e-3, 1e-4}) {
    Mat3 change = t * rate;
    REQUIRE(retract_change(a, change));
    CHECK((change - t * rate).norm() < 2 * t * t);
  }
}

TEST_CASE("inverted maps are not retracted", "[affine]") {
  const Mat3 a = turned(1, {0, 1, 1});
  const Mat3 straight = -1.5 * a + skew(spin) * a;
  Mat3 change = straight;
  CHECK_FALSE(retract_change(a, change));
  CHECK(change == straight);
}
