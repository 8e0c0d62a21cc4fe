// Distance to a surface and overlap depth of two: closed forms of cubes.
#include "geometry/mesh/overlap_depth.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "geometry/level_set/distance_formulas.hpp"
#include "geometry/shapes/kuhn.hpp"

using namespace tack;

namespace {

// The cube from -1 to 1.
SurfaceDistance cube(int cells) { return SurfaceDistance(kuhn_cube("cube", {cells, cells, cells}, {false, false, false})); }

class Points {
 public:
  Vec3 operator()(double size) { return {size * number(), size * number(), size * number()}; }

 private:
  double number() { return std::uniform_real_distribution<double>(-1, 1)(generator_); }
  std::mt19937 generator_{1};
};

}  // namespace

TEST_CASE("the signed distance to a cube agrees with its formula for any mesh", "[mesh][overlap]") {
  Points random;
  for (const int cells : {1, 3}) {
    const SurfaceDistance surface = cube(cells);
    CHECK(surface.closed());
    CHECK(surface.volume() == Approx(8));
    CHECK(surface.middle().norm() < 1e-12);
    for (int trial = 0; trial < 200; ++trial) {
      const Vec3 p = random(2);
      const double d = box_distance(p, Vec3::Ones());
      const auto closest = surface.at(p, 10);
      REQUIRE(closest);
      CHECK(closest->distance == Approx(d).margin(1e-12));
      CHECK(closest->away.norm() == Approx(1));
      // Along `away`, the distance grows by as much as one moves.
      CHECK(box_distance(p + 1e-6 * closest->away, Vec3::Ones()) - d == Approx(1e-6).epsilon(1e-3));
      CHECK(surface.at(p, std::abs(d) * 0.99).has_value() == false);
    }
  }
}

TEST_CASE("an open surface has an unsigned distance, and none on the surface", "[mesh][overlap]") {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const SurfaceDistance surface(mesh);
  CHECK_FALSE(surface.closed());
  for (const double side : {1.0, -1.0}) {
    const auto closest = surface.at({0.2, 0.3, side * 0.4}, 1);
    REQUIRE(closest);
    CHECK(closest->distance == Approx(0.4));
    CHECK((closest->away - side * Vec3::UnitZ()).norm() < 1e-12);
  }
  CHECK_FALSE(surface.at({0.2, 0.3, 0}, 1).has_value());
}

TEST_CASE("cubes that overlap at a face have the depth of the overlap and separate along the axis", "[mesh][overlap]") {
  const SurfaceDistance first = cube(2), second = cube(3);
  for (const double depth : {0.02, 0.1, 0.3})
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {1.0, -1.0}) {
        Vec3 by = Vec3(0.13, -0.21, 0.17);
        by[axis] = sign * (2 - depth);
        const auto overlap = overlap_depth(first, Vec3::Zero(), second, by, 0.5, 1);
        REQUIRE(overlap);
        CHECK(overlap->distance == Approx(-depth));
        CHECK((overlap->away + sign * Vec3::Unit(axis)).norm() < 1e-9);
        // A common motion changes nothing.
        const Vec3 common(5, -3, 2);
        const auto moved = overlap_depth(first, common, second, by + common, 0.5, 1);
        REQUIRE(moved);
        CHECK(moved->distance == Approx(-depth).margin(1e-9));
        // The point is in the intersection of both.
        for (const Vec3& centre : {common, Vec3(common + by)}) CHECK((moved->at - centre).cwiseAbs().maxCoeff() <= 1 + 1e-9);
        // With the cubes exchanged, the direction is reversed.
        const auto other = overlap_depth(second, by, first, Vec3::Zero(), 0.5, 1);
        REQUIRE(other);
        CHECK(other->distance == Approx(-depth));
        CHECK((other->away - sign * Vec3::Unit(axis)).norm() < 1e-9);
      }
}

TEST_CASE("separate cubes have their distance, and none beyond the range", "[mesh][overlap]") {
  const SurfaceDistance first = cube(2), second = cube(2);
  const auto near = overlap_depth(first, Vec3::Zero(), second, {2.3, 0.1, 0.2}, 0.5, 1);
  REQUIRE(near);
  CHECK(near->distance == Approx(0.3));
  CHECK((near->away + Vec3::UnitX()).norm() < 1e-9);
  CHECK_FALSE(overlap_depth(first, Vec3::Zero(), second, {2.6, 0.1, 0.2}, 0.5, 1).has_value());
  CHECK_FALSE(overlap_depth(first, Vec3::Zero(), second, {9, 0, 0}, 0.5, 1).has_value());
}
