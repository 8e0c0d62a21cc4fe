#include "geometry/distance/triangle_triangle.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

using namespace tack;

namespace {

using Corners = std::array<Vec3, 3>;

// Returns the distance of grid points of both: larger than the exact distance by less than a step.
double by_points(const Corners& a, const Corners& b, int n) {
  const auto points = [n](const Corners& c) {
    std::vector<Vec3> all;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) all.push_back(c[0] + (c[1] - c[0]) * i / n + (c[2] - c[0]) * j / n);
    return all;
  };
  const std::vector<Vec3> ofs = points(b);
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points(a))
    for (const Vec3& q : ofs) least = std::min(least, (p - q).norm());
  return least;
}

}  // namespace

TEST_CASE("triangles: a lower bound of the distance, which is exact for small distances", "[geometry]") {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto triangle = [&](const Vec3& at) {
    Corners c;
    for (Vec3& p : c) p = at + Vec3(uniform(engine), uniform(engine), uniform(engine));
    return c;
  };
  int exact = 0, bounds = 0;
  for (int i = 0; i < 400; ++i) {
    // One triangle on each side of z = 0, so that they have no common point.
    Corners a = triangle(Vec3(0, 0, 1)), b = triangle(Vec3(3 * uniform(engine), uniform(engine), -1));
    const double enough = 1.5 + uniform(engine), apart = triangles_apart(a, b, enough), near = by_points(a, b, 12);
    CHECK(apart == Approx(triangles_apart(b, a, enough)));
    CHECK(apart <= near + 1e-12);
    if (apart < enough) {
      CHECK(apart > near - 0.35);
      CHECK(apart == Approx(triangles_apart(a, b, 100)));
      ++exact;
    } else {
      CHECK(triangles_apart(a, b, 100) >= enough - 1e-12);
      ++bounds;
    }
  }
  CHECK(exact > 50);
  CHECK(bounds > 50);
}

TEST_CASE("triangles: crossing edges, parallel faces, a corner over a face", "[geometry]") {
  const Corners flat = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  CHECK(triangles_apart(flat, {Vec3(0.2, 0.2, 0.3), Vec3(1, 1, 2), Vec3(-1, 0, 2)}, 9) == Approx(0.3));
  CHECK(triangles_apart(flat, {Vec3(0, 0, 0.4), Vec3(1, 0, 0.4), Vec3(0, 1, 0.4)}, 9) == Approx(0.4));
  CHECK(triangles_apart(flat, {Vec3(0.5, -1, 0.2), Vec3(0.5, 2, 0.2), Vec3(0.5, 0, 3)}, 9) == Approx(0.2));
  CHECK(triangles_apart(flat, {Vec3(3, 0, 0), Vec3(4, 0, 0), Vec3(3, 1, 0)}, 9) == Approx(2));
}
