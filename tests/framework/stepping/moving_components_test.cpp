// Connected components and their motion: a relative displacement is a lower bound of the motion of
// any two points against each other, and does not depend on a common motion.
#include "framework/stepping/moving_components.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/framework/stepping/hand_made_world.hpp"

using namespace tack;

namespace {

// Points of one component with their displacements.
struct Points {
  std::vector<Vec3> at, by;
  MovingComponent component() const {
    MovingComponent c;
    double squares = 0;
    for (size_t i = 0; i < at.size(); ++i) {
      c.box.include(at[i]);
      c.displacement.include(by[i]);
      c.mean += by[i] / static_cast<double>(at.size());
      squares += by[i].squaredNorm() / static_cast<double>(at.size());
    }
    c.deviation = std::sqrt(std::max(0.0, squares - c.mean.squaredNorm()));
    return c;
  }
};

Points random_points(RandomPoints& random, double size, double motion) {
  Points p;
  const Vec3 centre = random.point(1), by = random.point(2);
  for (int i = 0; i < 6; ++i) {
    p.at.push_back(centre + random.point(size));
    p.by.push_back(by + random.point(motion));
  }
  return p;
}

// n separate small triangles, each an object of its own.
SurfaceBuilder triangles(RandomPoints& random, int n, double size) {
  SurfaceBuilder builder;
  for (int i = 0; i < n; ++i) {
    const Vec3 centre = random.point(1);
    builder.add_triangle(Vec3(centre + random.point(size)), Vec3(centre + random.point(size)), Vec3(centre + random.point(size)), i);
  }
  return builder;
}

}  // namespace

TEST_CASE("components are connected by edges, tets and frames, and each particle is a component", "[stepping][components]") {
  SurfaceBuilder builder;
  builder.add_rectangle({2, 2}, 0, {0, 0, 0}, 1, 1);                     // vertices 0 to 8
  builder.add_triangle({5, 0, 0}, {6, 0, 0}, {5, 1, 0}, 0);              // 9 to 11: apart from the rectangle
  builder.add_triangle({0, 0, 3}, {1, 0, 3}, {0, 1, 3}, 1);              // 12 to 14
  builder.add_triangle({0, 0, 4}, {1, 0, 4}, {0, 1, 4}, 1);              // 15 to 17: a tet joins it to the last one
  builder.add_triangle({0, 0, 6}, {1, 0, 6}, {0, 1, 6}, 2);              // 18 to 20
  builder.add_triangle({0, 0, 7}, {1, 0, 7}, {0, 1, 7}, 2);              // 21 to 23: of one affine body
  builder.add_rod({{0, 0, 9}, {1, 0, 9}, {2, 0, 9}}, 3, 0.1);            // 24 to 26
  for (int i = 0; i < 2; ++i) builder.add_particle({8.0 + i, 8, 8}, 4, 0.25);  // 27, 28
  HandMadeWorld made(builder, 0.1);
  made.world.bodies[1].tets = {{12, 13, 14, 15}};
  made.world.bodies[2].frame = {0, 0, 0, 0};
  const MovingComponents components(made.world);
  CHECK(components.count() == 7);
  const auto joined = [&](int a, int b) { return components.component_of(a) == components.component_of(b); };
  for (int v = 0; v < 9; ++v) CHECK(joined(v, 0));
  CHECK_FALSE(joined(9, 0));
  CHECK(joined(9, 11));
  CHECK(joined(12, 17));
  CHECK(joined(18, 23));
  CHECK(joined(24, 26));
  CHECK_FALSE(joined(27, 28));
  CHECK(components[components.component_of(27)].width == 0.5);
  CHECK(components[components.component_of(27)].object == 4);
  CHECK(components[components.component_of(24)].width == 0);
}

TEST_CASE("a relative displacement is a lower bound of the largest relative displacement of two points", "[stepping][components]") {
  RandomPoints random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const Points a = random_points(random, random.uniform(0.01, 1), random.uniform(0, 0.5)), b = random_points(random, random.uniform(0.01, 1), random.uniform(0, 0.5));
    const MovingComponent one = a.component(), other = b.component();
    double least = 1e9, most = 0;
    for (const Vec3& p : a.by)
      for (const Vec3& q : b.by) least = std::min(least, (p - q).norm()), most = std::max(most, (p - q).norm());
    const double size = smaller_size(one, other, 0), relative = one.displacement_against(other, size);
    CHECK(relative <= most * (1 + 1e-12));
    // Where one of them is much larger than the other, it bounds all pairs of points.
    if (std::max(one.size(), other.size()) > 2 * size) CHECK(relative <= least * (1 + 1e-12));
  }
}

TEST_CASE("relative displacements of rigid translations are exact, symmetric, and free of a common motion", "[stepping][components]") {
  RandomPoints random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 d = random.point(1), e = random.point(1), common = random.point(9);
    const Points a = random_points(random, 0.3, 0), b = random_points(random, 0.4, 0);
    const auto moving = [](Points p, const Vec3& by) {
      std::fill(p.by.begin(), p.by.end(), by);
      return p.component();
    };
    const MovingComponent one = moving(a, d), other = moving(b, e);
    const double size = smaller_size(one, other, 0);
    CHECK(one.displacement_against(other, size) == Approx((d - e).norm()));
    CHECK(other.displacement_against(one, size) == Approx((d - e).norm()));
    CHECK(moving(a, d + common).displacement_against(moving(b, e + common), size) == Approx((d - e).norm()).margin(1e-6));
    CHECK(moving(a, d).displacement_against(moving(b, d), size) < 1e-6);
  }
}

TEST_CASE("swept boxes contain the starts and the ends of all vertices", "[stepping][components]") {
  RandomPoints random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const Points p = random_points(random, 0.3, 0.2);
    const Aabb swept = p.component().swept();
    for (size_t i = 0; i < p.at.size(); ++i) {
      CHECK(swept.contains(p.at[i]));
      CHECK(swept.contains(p.at[i] + p.by[i]));
    }
  }
}

TEST_CASE("motions of components are those of their vertices", "[stepping][components]") {
  RandomPoints random(4);
  HandMadeWorld made(triangles(random, 3, 0.2), 0.05);
  MovingComponents components(made.world);
  const VecX& x = made.world.rest;
  VecX y = x;
  for (int v = 0; v < 9; ++v) vertex(y, v) += random.point(0.3);
  for (int repeat = 0; repeat < 2; ++repeat) {  // nothing is left of the motion before
    components.move(x, y);
    for (int c = 0; c < 3; ++c) {
      Points p;
      for (int v = 3 * c; v < 3 * c + 3; ++v) p.at.push_back(vertex(x, v)), p.by.push_back(vertex(y, v) - vertex(x, v));
      const MovingComponent expected = p.component(), &found = components[components.component_of(3 * c)];
      CHECK(found.box.lo == expected.box.lo);
      CHECK(found.box.hi == expected.box.hi);
      CHECK(found.displacement.lo == expected.displacement.lo);
      CHECK(found.displacement.hi == expected.displacement.hi);
      CHECK((found.mean - expected.mean).norm() < 1e-12);
      CHECK(found.deviation == Approx(expected.deviation).margin(1e-9));
    }
    components.move(y, x);
    components.move(x, y);
  }
}

TEST_CASE("pairs that may tunnel are those of brute force, without pairs that do not collide", "[stepping][components]") {
  RandomPoints random(5);
  size_t found = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 12;
    CollidingObjects colliding;
    for (int a = 0; a < n; ++a)
      for (int b = a; b < n; ++b) colliding.set(a, b, random.uniform(0, 1) < 0.7);
    HandMadeWorld made(triangles(random, n, 0.15), 0.01, colliding);
    MovingComponents components(made.world);
    VecX y = made.world.rest;
    for (int c = 0; c < n; ++c) {
      const Vec3 by = random.point(trial % 5 ? 1 : 0.01);
      for (int v = 3 * c; v < 3 * c + 3; ++v) vertex(y, v) += by + random.point(0.01);
    }
    components.move(made.world.rest, y);
    const double fraction = 0.5, least = 0.02;
    std::vector<std::array<int, 2>> expected;
    for (int a = 0; a < n; ++a)
      for (int b = a + 1; b < n; ++b) {
        const MovingComponent &one = components[a], &other = components[b];
        const double size = std::max(least, std::min(one.size(), other.size()));
        if (one.displacement_against(other, size) > fraction * size && one.swept().overlaps(other.swept()) && colliding.allows(one.object, other.object))
          expected.push_back({a, b});
      }
    found += expected.size();
    CHECK(components.tunnelling_pairs(fraction, least) == expected);
  }
  CHECK(found > 30);
}
