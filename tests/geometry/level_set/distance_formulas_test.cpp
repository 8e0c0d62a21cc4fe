// Signed distances by formulas: closed forms, and the properties of every exact distance: slope one,
// zero on the surface, negative inside.
#include "geometry/level_set/distance_formulas.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "geometry/level_set/polygon_distance.hpp"

using namespace tack;

namespace {

using Distance = std::function<double(const Vec3&)>;

class Points {
 public:
  Vec3 operator()(double size) { return {size * number(), size * number(), size * number()}; }
  double number() { return std::uniform_real_distribution<double>(-1, 1)(generator_); }

 private:
  std::mt19937 generator_{1};
};

const std::vector<std::pair<const char*, Distance>> formulas = {
    {"sphere", [](const Vec3& p) { return sphere_distance(p, 0.7); }},
    {"box", [](const Vec3& p) { return box_distance(p, {0.5, 0.7, 0.3}); }},
    {"torus", [](const Vec3& p) { return torus_distance(p, 0.7, 0.2); }},
    {"cone", [](const Vec3& p) { return cone_distance(p, 0.7, 0, 1); }},
    {"frustum", [](const Vec3& p) { return cone_distance(p, 0.3, 0.6, 1.2); }},
    {"cylinder", [](const Vec3& p) { return cone_distance(p, 0.5, 0.5, 1); }},
    {"extruded disc", [](const Vec3& p) { return extruded_distance(p.head<2>().norm() - 0.6, p.z(), 0.4); }},
};

}  // namespace

TEST_CASE("no distance formula is steeper than one, and all have slope one almost everywhere", "[level_set]") {
  Points random;
  for (const auto& [name, distance] : formulas) {
    INFO(name);
    int steep = 0;
    for (int trial = 0; trial < 400; ++trial) {
      const Vec3 p = random(1.5), q = p + random(0.3);
      CHECK(std::abs(distance(p) - distance(q)) <= (p - q).norm() * (1 + 1e-12));
      const double h = 1e-6;
      Vec3 slope;
      for (int i = 0; i < 3; ++i) slope[i] = (distance(p + h * Vec3::Unit(i)) - distance(p - h * Vec3::Unit(i))) / (2 * h);
      steep += std::abs(slope.norm() - 1) < 1e-4;
    }
    CHECK(steep > 390);  // but for points beside the medial surface
  }
}

TEST_CASE("the closest point of the surface lies at the distance along the slope", "[level_set]") {
  Points random;
  for (const auto& [name, distance] : formulas) {
    INFO(name);
    for (int trial = 0; trial < 100; ++trial) {
      const Vec3 p = random(1.5);
      const double h = 1e-6, d = distance(p);
      Vec3 slope;
      for (int i = 0; i < 3; ++i) slope[i] = (distance(p + h * Vec3::Unit(i)) - distance(p - h * Vec3::Unit(i))) / (2 * h);
      if (std::abs(slope.norm() - 1) > 1e-4) continue;
      CHECK(std::abs(distance(p - d * slope)) < 1e-4);
    }
  }
}

TEST_CASE("distances to primitives have their closed forms on the axes", "[level_set]") {
  CHECK(box_distance({0, 0, 0}, {1, 2, 3}) == -1);
  CHECK(box_distance({2, 0, 0}, {1, 2, 3}) == 1);
  CHECK(box_distance({4, 6, 0}, {1, 2, 3}) == 5);
  CHECK(torus_distance({0.7, 0, 0}, 0.7, 0.2) == Approx(-0.2));
  CHECK(torus_distance({0, 0, 0}, 0.7, 0.2) == Approx(0.5));
  CHECK(torus_distance({0, 0.3, 0.7}, 0.7, 0.2) == Approx(0.1));
  // A cone of half angle 45 degrees: its side is at (r + y - 1/2) / sqrt 2.
  CHECK(cone_distance({0.5, 0.5, 0}, 1, 0, 1) == Approx(0.5 / std::sqrt(2)));
  CHECK(cone_distance({0, 1.5, 0}, 1, 0, 1) == Approx(1));
  CHECK(cone_distance({0, -0.4, 0}, 1, 0, 1) == Approx(-0.1));
  CHECK(cone_distance({0.2, -0.9, 0}, 1, 0, 1) == Approx(0.4));
}

TEST_CASE("a frustum with equal radii is an extruded disc", "[level_set]") {
  Points random;
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 p = random(1.5);
    CHECK(cone_distance(p, 0.5, 0.5, 1) == Approx(extruded_distance(std::hypot(p.x(), p.z()) - 0.5, p.y(), 0.5)).margin(1e-12));
  }
}

TEST_CASE("the distance to a segment is that to its nearest point, to a point if it has no length", "[level_set]") {
  CHECK(segment_distance(Vec3(0.3, 0.4, 0), Vec3(0, 0, 0), Vec3(1, 0, 0)) == Approx(0.4));
  CHECK(segment_distance(Vec3(-3, 4, 0), Vec3(0, 0, 0), Vec3(1, 0, 0)) == Approx(5));
  CHECK(segment_distance(Vec2(3, 4), Vec2(0, 0), Vec2(0, 0)) == Approx(5));
  Points random;
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 p = random(1), a = random(1), b = random(1);
    const double d = segment_distance(p, a, b);
    CHECK(d == Approx(segment_distance(p, b, a)));
    double nearest = 9;
    for (int k = 0; k <= 1000; ++k) nearest = std::min(nearest, (p - a - k / 1000.0 * (b - a)).norm());
    CHECK(d <= nearest * (1 + 1e-12));
    CHECK(d == Approx(nearest).margin(2e-3));
  }
}

TEST_CASE("a blended minimum is the minimum where the two differ by the blend, and a quarter of it below where they are equal", "[level_set]") {
  Points random;
  CHECK(blended_min(0.3, 0.3, 0.2) == Approx(0.25));
  CHECK(blended_min(0.3, 0.5, 0.2) == Approx(0.3));
  CHECK(blended_min(0.5, 0.3, 0) == 0.3);
  for (int trial = 0; trial < 100; ++trial) {
    const double a = random.number(), b = random.number(), blend = 0.5;
    const double m = blended_min(a, b, blend);
    CHECK(m == blended_min(b, a, blend));
    CHECK(m <= std::min(a, b));
    CHECK(m >= std::min(a, b) - blend / 4);
    // No steeper than the steeper one.
    const double da = 1e-3 * random.number(), db = 1e-3 * random.number();
    CHECK(std::abs(blended_min(a + da, b + db, blend) - m) <= std::max(std::abs(da), std::abs(db)) * (1 + 1e-9));
  }
}

TEST_CASE("the distance to a rectangular polygon is that of a box, whatever the orientation and the first corner", "[level_set]") {
  Points random;
  std::vector<Vec2> corners = {{-0.5, -0.3}, {0.5, -0.3}, {0.5, 0.3}, {-0.5, 0.3}};
  for (int turn = 0; turn < 8; ++turn) {
    if (turn == 4) std::reverse(corners.begin(), corners.end());
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    for (int trial = 0; trial < 50; ++trial) {
      const Vec3 p = random(1);
      CHECK(polygon_distance(p.head<2>(), corners) == Approx(box_distance({p.x(), p.y(), 0}, {0.5, 0.3, 9})).margin(1e-12));
    }
  }
}

TEST_CASE("points that a polygon encloses twice are outside, by the even-odd rule", "[level_set]") {
  // A pentagram: its inner pentagon is enclosed twice.
  std::vector<Vec2> star;
  for (int i = 0; i < 5; ++i) star.push_back({std::sin(4 * M_PI / 5 * i), std::cos(4 * M_PI / 5 * i)});
  CHECK(polygon_distance({0, 0}, star) == Approx(std::cos(2 * M_PI / 5)));  // the radius of the circle within
  CHECK(polygon_distance({0, 0.8}, star) < 0);
  CHECK(polygon_distance({0.8, 0.8}, star) > 0);
}
