// Control vertices of vertices that move affinely.
#include <Eigen/Geometry>

#include "framework/stepping/affine_controls.hpp"

#include <catch2/catch.hpp>

#include <numeric>

using namespace tack;

namespace {

// A grid of points in the unit cube, seen by an affine map.
struct Points {
  VecX x;
  std::vector<int> all;

  Points(int nx, int ny, int nz, const Mat3& map, const Vec3& shift = Vec3::Zero()) : x(3 * nx * ny * nz), all(static_cast<size_t>(nx * ny * nz)) {
    std::iota(all.begin(), all.end(), 0);
    for (int i = 0, v = 0; i < nx; ++i)
      for (int j = 0; j < ny; ++j)
        for (int k = 0; k < nz; ++k, ++v) vertex(x, v) = map * Vec3(0.2 * i, 0.3 * j, 0.1 * k) + shift;
  }
};

Mat3 turned(double angle) { return Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix(); }

}  // namespace

TEST_CASE("all vertices of a solid depend on four, of a plane on three, of a line on two") {
  const auto count = [](int nx, int ny, int nz) {
    const Points p(nx, ny, nz, turned(1));
    return std::pair{p.all.size() - affine_dependences(p.all, p.x).size(), p.all.size()};
  };
  CHECK(count(4, 3, 5) == std::pair<size_t, size_t>{4, 60});
  CHECK(count(4, 3, 1) == std::pair<size_t, size_t>{3, 12});
  CHECK(count(1, 6, 1) == std::pair<size_t, size_t>{2, 6});
  CHECK(count(1, 1, 1) == std::pair<size_t, size_t>{1, 1});
}

TEST_CASE("the weights of dependences add up to one, and none is large") {
  const Points p(6, 5, 4, turned(0.7), Vec3(3, -2, 1));
  for (const Dependence& d : affine_dependences(p.all, p.x)) {
    double sum = 0;
    for (const auto& [on, weight] : d.on) {
      sum += weight;
      CHECK(std::abs(weight) < 3);
    }
    CHECK(sum == Approx(1).epsilon(1e-14));
  }
}

TEST_CASE("dependences hold after an affine motion, and after no other") {
  const Points p(4, 3, 5, turned(0.3), Vec3(0.1, 0, 0));
  const Dependences found = affine_dependences(p.all, p.x);
  CHECK(hold(found, p.x));
  CHECK(hold(found, Points(4, 3, 5, turned(2.5), Vec3(-7, 4, 2)).x));
  Mat3 shear = Mat3::Identity();
  shear(0, 1) = 0.5;
  CHECK(hold(found, Points(4, 3, 5, shear).x));
  Points bent = p;
  vertex(bent.x, 17).y() += 1e-6;
  CHECK_FALSE(hold(found, bent.x));
}

TEST_CASE("dependences hold far from the origin, and those of a line hold for any rotation") {
  const Points far(3, 3, 3, turned(1), Vec3(1e6, 0, 0));
  CHECK(hold(affine_dependences(far.all, far.x), far.x));
  const Points line(1, 5, 1, turned(0.2));
  CHECK(hold(affine_dependences(line.all, line.x), Points(1, 5, 1, turned(3)).x));
}

TEST_CASE("round-off of dependences is 1e-9 of the size of the vertices") {
  // The distance from the plane of other control vertices counts from there on.
  const auto controls = [](double lifted) {
    Points plate(4, 3, 1, Mat3::Identity());  // 0.6 m wide
    vertex(plate.x, 5).z() += lifted;
    return plate.all.size() - affine_dependences(plate.all, plate.x).size();
  };
  CHECK(controls(2e-10) == 3);
  CHECK(controls(2e-9) == 4);
  // So does the position of a dependent vertex.
  const auto holds = [](double off) {
    Points p(4, 3, 5, Mat3::Identity());  // 0.94 m from corner to corner
    const Dependences found = affine_dependences(p.all, p.x);
    vertex(p.x, found.front().vertex).y() += off;
    return hold(found, p.x);
  };
  CHECK(holds(2e-10));
  CHECK_FALSE(holds(2e-9));
}
