// Lagged surface: normals, areas and projected tributary areas, by closed forms.
#include "framework/contact/surface/lagged_surface.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/framework/contact/surface_builder.hpp"

using namespace tack;

namespace {

// Tributary area of a vertex towards a surface of unit normal n, as its header defines it.
double area_towards(const SurfaceAt& s, int v, const Vec3& n) {
  double sum = 0;
  for (const int t : s.lagged.topology().triangles_at(v)) sum += s.lagged.area(t) / 3 * std::max(0.0, s.lagged.cosine(t, n));
  return sum;
}

}  // namespace

TEST_CASE("areas and normals of the lagged surface are those of its positions, not of rest", "[contact][lagged]") {
  SurfaceBuilder builder;
  builder.add_triangle({0, 0, 0}, {2, 0, 0}, {0, 3, 0}, 0);
  SurfaceAt s(builder);
  CHECK(s.lagged.area(0) == Approx(3));
  CHECK((s.lagged.normal(0) - Vec3::UnitZ()).norm() < 1e-15);
  CHECK(s.lagged.area_per_vertex(0) == Approx(6));
  VecX x = builder.x();
  for (int v = 0; v < 3; ++v) vertex(x, v) = Vec3(2 * x[3 * v], 0, -2 * x[3 * v + 1]);
  s.lagged.update(x);
  CHECK(s.lagged.area(0) == Approx(12));
  CHECK((s.lagged.normal(0) - Vec3::UnitY()).norm() < 1e-15);
  CHECK(s.lagged.x() == x);
}

TEST_CASE("a triangle without area has a zero normal", "[contact][lagged]") {
  SurfaceBuilder builder;
  builder.add_triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2}, 0);
  builder.add_triangle({1, 0, 0}, {1, 0, 0}, {1, 0, 0}, 0);
  const SurfaceAt s(builder);
  for (int t = 0; t < 2; ++t) {
    CHECK(s.lagged.area(t) == 0);
    CHECK(s.lagged.normal(t) == Vec3::Zero());
  }
}

TEST_CASE("tributary areas of all vertices add up to the area of the surface", "[contact][lagged]") {
  RandomPoints random(1);
  SurfaceBuilder builder;
  builder.add_grid({5, 4}, 0, [&](double u, double v) { return Vec3(Vec3(2 * u, 3 * v, 0) + random.point(0.1)); });
  const SurfaceAt s(builder);
  double vertices = 0, triangles = 0;
  for (const int v : s.surface.mesh.vertices) vertices += s.lagged.tributary_area(v);
  for (size_t t = 0; t < s.surface.mesh.triangles.size(); ++t) triangles += s.lagged.area(static_cast<int>(t));
  CHECK(vertices == Approx(triangles).epsilon(1e-12));
}

TEST_CASE("projected areas of a closed surface towards opposite directions are equal", "[contact][lagged]") {
  // The shadow of a convex body is the same from both sides; for a box it is |n_x| b c + |n_y| a c + |n_z| a b.
  RandomPoints random(2);
  SurfaceBuilder builder;
  builder.add_box({0, 0, 0}, {1, 2, 3}, 0);
  const SurfaceAt s(builder);
  for (int trial = 0; trial < 30; ++trial) {
    const Vec3 n = random.direction();
    double towards = 0, away = 0;
    for (int v = 0; v < 8; ++v) towards += area_towards(s, v, n), away += area_towards(s, v, -n);
    CHECK(towards == Approx(6 * std::abs(n.x()) + 3 * std::abs(n.y()) + 2 * std::abs(n.z())));
    CHECK(away == Approx(towards));
  }
}

TEST_CASE("the cosine of a solid's triangle changes its sign with the direction, that of a sheet does not", "[contact][lagged]") {
  RandomPoints random(3);
  SurfaceBuilder builder;
  builder.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0);
  builder.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, true);
  const SurfaceAt s(builder);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 n = random.direction();
    CHECK(s.lagged.cosine(0, n) == Approx(-n.z()));
    CHECK(s.lagged.cosine(0, -n) == Approx(n.z()));
    CHECK(s.lagged.cosine(1, n) == Approx(std::abs(n.z())));
    CHECK(s.lagged.cosine(1, -n) == s.lagged.cosine(1, n));
  }
}

TEST_CASE("lagged areas and cosines do not depend on rotation and translation", "[contact][lagged]") {
  RandomPoints random(4);
  SurfaceBuilder builder;
  builder.add_grid({3, 3}, 0, [&](double u, double v) { return Vec3(Vec3(u, v, 0) + random.point(0.1)); });
  const SurfaceAt s(builder);
  for (int trial = 0; trial < 5; ++trial) {
    const Mat3 r = random.rotation();
    const SurfaceAt turned(builder, moved(builder.x(), r, random.point(2)));
    const Vec3 n = random.direction();
    for (const int v : s.surface.mesh.vertices) {
      CHECK(turned.lagged.tributary_area(v) == Approx(s.lagged.tributary_area(v)));
      CHECK(turned.lagged.area_per_vertex(v, r * n) == Approx(s.lagged.area_per_vertex(v, n)).margin(1e-12));
      CHECK(area_towards(turned, v, r * n) == Approx(area_towards(s, v, n)).margin(1e-12));
    }
  }
}

TEST_CASE("the area per vertex at a vertex is the mean over the triangles that face the direction", "[contact][lagged]") {
  // Three triangles at the origin: two of them face downwards, with areas 1/2 and 2.
  SurfaceBuilder builder;
  const int o = builder.add_vertex({0, 0, 0}, 0), a = builder.add_vertex({1, 0, 0}, 0), b = builder.add_vertex({0, 1, 0}, 0);
  const int c = builder.add_vertex({-4, 0, 0}, 0), d = builder.add_vertex({0, 0, 5}, 0);
  builder.add_triangle({o, a, b});
  builder.add_triangle({o, b, c});
  builder.add_triangle({o, d, a});
  const SurfaceAt s(builder);
  CHECK(s.lagged.area_per_vertex(o, -Vec3::UnitZ()) == Approx((2 * 0.5 + 2 * 2) / 2));
  CHECK(s.lagged.area_per_vertex(o, Vec3::UnitZ()) == 0);
}

TEST_CASE("a rod has its length times its width from the side, and its cross-section at each end", "[contact][lagged]") {
  RandomPoints random(5);
  const double width = 0.2;
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 along = random.direction(), n = random.direction();
    SurfaceBuilder builder;
    const int first = builder.add_rod({{0, 0, 0}, 0.3 * along, 2 * along}, 0, width);
    const SurfaceAt s(builder);
    double projected = 0, largest = 0;
    for (int v = first; v < first + 3; ++v) projected += s.lagged.codimensional_area(v, n), largest += s.lagged.codimensional_area(v);
    const double sine = along.cross(n).norm(), cosine = std::abs(along.dot(n));
    CHECK(projected == Approx(2 * width * sine + 2 * M_PI / 4 * width * width * cosine));
    CHECK(largest == Approx(2 * width));
    CHECK(s.lagged.codimensional_area(first, -n) == s.lagged.codimensional_area(first, n));
  }
}

TEST_CASE("the area of a rod does not depend on its mesh", "[contact][lagged]") {
  const Vec3 n(0.6, 0.64, 0.48);
  for (const int edges : {1, 2, 7}) {
    SurfaceBuilder builder;
    std::vector<Vec3> points;
    for (int i = 0; i <= edges; ++i) points.push_back(Vec3(3.0 * i / edges, 0, 0));
    builder.add_rod(points, 0, 0.1);
    const SurfaceAt s(builder);
    double sum = 0;
    for (int v = 0; v <= edges; ++v) sum += s.lagged.codimensional_area(v, n);
    CHECK(sum == Approx(3 * 0.1 * 0.8 + M_PI / 2 * 0.01 * 0.6));
  }
}

TEST_CASE("a particle has its cross-section from every direction", "[contact][lagged]") {
  RandomPoints random(6);
  SurfaceBuilder builder;
  const int p = builder.add_particle({1, 2, 3}, 0, 0.3);
  const SurfaceAt s(builder);
  CHECK(s.lagged.codimensional_area(p) == Approx(M_PI * 0.09));
  for (int trial = 0; trial < 5; ++trial) CHECK(s.lagged.codimensional_area(p, random.direction()) == Approx(M_PI * 0.09));
}
