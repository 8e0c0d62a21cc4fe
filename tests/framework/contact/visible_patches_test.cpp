// Visible patches of a point: the triangles that it faces, their distances, and how far it lies past
// their boundary, by closed forms and against brute force.
#include "framework/contact/surface/visible_patches.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/distance/point_triangle.hpp"
#include "tests/framework/contact/surface_builder.hpp"

using namespace tack;

namespace {

// A triangle of object 0 that faces along `direction`; points of it see the triangles of object 1.
struct SeeingTriangle {
  SurfaceBuilder builder;
  explicit SeeingTriangle(const Vec3& direction) {
    const Vec3 u = direction.unitOrthogonal(), v = direction.cross(u);
    builder.add_triangle(Vec3::Zero(), u, v, 0);
  }
  std::vector<int> others() const {
    std::vector<int> list(builder.two_sided.size() - 1);
    std::iota(list.begin(), list.end(), 1);
    return list;
  }
};

VisiblePatches find_patches(const SurfaceAt& s, const Vec3& p, const std::vector<int>& triangles, double area = 1) {
  PatchFinder finder(s.surface.mesh, s.lagged);
  return finder.find(finder.inside_triangle(0, p, area), static_cast<int>(triangles.size()), [&](int i) { return triangles[static_cast<size_t>(i)]; });
}

double distance_to(const SurfaceAt& s, const Vec3& p, int triangle) {
  const auto [a, b, c] = corners(s.lagged.x(), s.surface.mesh.triangles[static_cast<size_t>(triangle)]);
  return std::sqrt(point_triangle_distance(p, a, b, c));
}

const Vec3 down = -Vec3::UnitZ();

}  // namespace

TEST_CASE("a point above a plane sees one patch, at its height, whatever the mesh of the plane", "[contact][visibility]") {
  for (const std::array<int, 2> cells : {std::array{1, 1}, std::array{3, 2}, std::array{8, 7}}) {
    SeeingTriangle seeing(down);
    seeing.builder.add_rectangle(cells, 1, {-1, -1, 0}, 2, 2);
    const SurfaceAt s(seeing.builder);
    for (const double height : {1e-9, 1e-3, 0.2}) {
      const VisiblePatches visible = find_patches(s, {0.31, 0.17, height}, seeing.others(), 0.7);
      REQUIRE(visible.count == 1);
      CHECK(visible.patches[0].distance == Approx(height));
      CHECK(visible.patches[0].overshoot == 0);
      CHECK(visible.patches[0].area == Approx(0.7));
      CHECK((visible.patches[0].normal - Vec3::UnitZ()).norm() < 1e-15);
      CHECK(visible.patches[0].area_per_vertex == Approx(4.0 / cells[0] / cells[1]));
    }
  }
}

TEST_CASE("the area of a point towards a plane is its area times the cosine of the tilt, none past a right angle", "[contact][visibility]") {
  for (const double degrees : {0.0, 20.0, 60.0, 89.0, 91.0, 180.0}) {
    const double angle = degrees / 180 * M_PI;
    SeeingTriangle seeing({std::sin(angle), 0, -std::cos(angle)});
    seeing.builder.add_rectangle({1, 1}, 1, {-1, -1, 0}, 2, 2);
    const SurfaceAt s(seeing.builder);
    const VisiblePatches visible = find_patches(s, {0.1, 0.2, 0.3}, seeing.others());
    INFO(degrees);
    REQUIRE(visible.count == (degrees < 90 ? 1 : 0));
    if (visible.count) CHECK(visible.patches[0].area == Approx(std::cos(angle)));
  }
}

TEST_CASE("a point behind a solid's face sees no patch, a point behind a sheet sees its other side", "[contact][visibility]") {
  for (const bool sheet : {false, true}) {
    SeeingTriangle seeing(Vec3::UnitZ());
    seeing.builder.add_rectangle({2, 2}, 1, {-1, -1, 0}, 2, 2, true, sheet);
    const SurfaceAt s(seeing.builder);
    const VisiblePatches visible = find_patches(s, {0.1, 0.2, -0.3}, seeing.others());
    REQUIRE(visible.count == (sheet ? 1 : 0));
    if (!sheet) continue;
    CHECK((visible.patches[0].normal - down).norm() < 1e-15);
    CHECK(visible.patches[0].distance == Approx(0.3));
  }
}

TEST_CASE("past a boundary, the overshoot is the distance to it in the plane", "[contact][visibility]") {
  for (const std::array<int, 2> cells : {std::array{1, 1}, std::array{4, 5}}) {
    SeeingTriangle seeing(down);
    seeing.builder.add_rectangle(cells, 1, {0, 0, 0}, 1, 1);
    const SurfaceAt s(seeing.builder);
    for (const Vec3& p : {Vec3(1.2, 0.43, 0.1), Vec3(0.3, -0.01, 0.4), Vec3(1.3, 1.4, 0.2), Vec3(-1e-7, 0.37, 0.2), Vec3(-0.5, -0.1, 1e-6)}) {
      const VisiblePatches visible = find_patches(s, p, seeing.others());
      const Vec3 past = p - Vec3(std::clamp(p.x(), 0.0, 1.0), std::clamp(p.y(), 0.0, 1.0), p.z());
      REQUIRE(visible.count == 1);
      CHECK(visible.patches[0].overshoot == Approx(past.norm()).margin(1e-8));
      CHECK(visible.patches[0].distance == Approx(std::hypot(past.norm(), p.z())));
    }
  }
}

TEST_CASE("a smooth surface continues across its inner edges: the overshoot is zero there", "[contact][visibility]") {
  // A cylinder of radius 1 in facets of 9 degrees.
  const int n = 10;
  const auto ridge = [](double u, double v) { return Vec3(std::sin(M_PI / 2 * (u - 0.5)), v, std::cos(M_PI / 2 * (u - 0.5))); };
  SeeingTriangle seeing(down);
  seeing.builder.add_grid({n, 3}, 1, ridge);
  const SurfaceAt s(seeing.builder);
  for (const double u : {0.2, 0.5, 0.63}) {  // 0.2 and 0.5 lie over edges
    const VisiblePatches visible = find_patches(s, 1.1 * ridge(u, 0) + Vec3(0, 0.44, 0), seeing.others());
    REQUIRE(visible.count == 1);
    CHECK(visible.patches[0].overshoot == 0);
    CHECK(visible.patches[0].distance == Approx(0.1).margin(1 - std::cos(M_PI / 40)));
  }
}

TEST_CASE("a point in a corner of three faces sees three patches, the nearest first", "[contact][visibility]") {
  SeeingTriangle seeing(-Vec3(1, 1, 1).normalized());
  const auto face = [&](const Vec3& u, const Vec3& v) { seeing.builder.add_grid({3, 3}, 1, [=](double a, double b) { return Vec3(a * u + b * v); }); };
  face(Vec3::UnitX(), Vec3::UnitY());
  face(Vec3::UnitY(), Vec3::UnitZ());
  face(Vec3::UnitZ(), Vec3::UnitX());
  const SurfaceAt s(seeing.builder);
  const VisiblePatches visible = find_patches(s, {0.21, 0.13, 0.17}, seeing.others());
  REQUIRE(visible.count == 3);
  const std::array<double, 3> distances = {0.13, 0.17, 0.21};
  const std::array<Vec3, 3> normals = {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
  for (int k = 0; k < 3; ++k) {
    CHECK(visible.patches[k].distance == Approx(distances[k]));
    CHECK((visible.patches[k].normal - normals[k]).norm() < 1e-12);
    CHECK(visible.patches[k].area == Approx(1 / std::sqrt(3)));
    CHECK(visible.patch_of(normals[k]) == k);
  }
  CHECK(visible.patch_of(-Vec3::UnitX()) == -1);
}

TEST_CASE("over an edge of a box, the seed triangle is of the face that the point faces most", "[contact][visibility]") {
  for (const bool top : {true, false}) {
    SeeingTriangle seeing(top ? Vec3(-1, 0, -2).normalized() : Vec3(-2, 0, -1).normalized());
    seeing.builder.add_box({0, 0, 0}, {1, 1, 1}, 1);
    const SurfaceAt s(seeing.builder);
    const VisiblePatches visible = find_patches(s, {1.2, 0.4, 1.1}, seeing.others());
    REQUIRE(visible.count == 2);
    CHECK((visible.patches[0].normal - (top ? Vec3::UnitZ() : Vec3::UnitX())).norm() < 1e-12);
    CHECK((visible.patches[1].normal - (top ? Vec3::UnitX() : Vec3::UnitZ())).norm() < 1e-12);
    CHECK(visible.patches[top ? 0 : 1].overshoot == Approx(0.2));
    CHECK(visible.patches[top ? 1 : 0].overshoot == Approx(0.1));
    for (int k = 0; k < 2; ++k) CHECK(visible.patches[k].distance == Approx(std::hypot(0.2, 0.1)));
  }
}

TEST_CASE("the first patch is the nearest of all triangles that face the point, by brute force", "[contact][visibility]") {
  RandomPoints random(1);
  int seen = 0;
  for (int trial = 0; trial < 300; ++trial) {
    SeeingTriangle seeing(random.direction());
    for (int t = 0; t < 12; ++t) {
      const Vec3 centre = random.point(1);
      seeing.builder.add_triangle(Vec3(centre + random.point(0.3)), Vec3(centre + random.point(0.3)), Vec3(centre + random.point(0.3)), 1, t % 3 == 0);
    }
    const SurfaceAt s(seeing.builder);
    const Vec3 p = random.point(1);
    double nearest = std::numeric_limits<double>::infinity();
    for (const int t : seeing.others()) {
      Vec3 n = s.lagged.normal(t);
      const double height = n.dot(p - corners(s.lagged.x(), s.surface.mesh.triangles[static_cast<size_t>(t)])[0]);
      if (height <= 0 && !s.lagged.topology().two_sided(t)) continue;
      if (height < 0) n = -n;
      if (s.lagged.normal(0).dot(n) < 0) nearest = std::min(nearest, distance_to(s, p, t));
    }
    const VisiblePatches visible = find_patches(s, p, seeing.others());
    CHECK((visible.count > 0) == std::isfinite(nearest));
    if (visible.count == 0) continue;
    ++seen;
    CHECK(visible.patches[0].distance == Approx(nearest).epsilon(1e-6));
    for (int k = 1; k < visible.count; ++k) {
      CHECK(visible.patches[k].distance >= visible.patches[k - 1].distance * (1 - 1e-6));
      for (int other = 0; other < k; ++other) CHECK(visible.patches[other].normal.dot(visible.patches[k].normal) <= std::cos(50 * M_PI / 180));
    }
    // Within a distance, the patches are those of the triangles within it.
    PatchFinder finder(s.surface.mesh, s.lagged);
    const QueryPoint from = finder.inside_triangle(0, p, 1);
    std::vector<int> near;
    for (const int t : seeing.others())
      if (distance_to(s, p, t) < 0.6) near.push_back(t);
    const VisiblePatches within = finder.find_within(from, seeing.others(), 0.6), of_near = find_patches(s, p, near);
    REQUIRE(within.count == of_near.count);
    for (int k = 0; k < within.count; ++k) CHECK(within.patches[k].seed_triangle == of_near.patches[k].seed_triangle);
  }
  CHECK(seen > 150);
}

TEST_CASE("visible patches do not depend on the order of triangles, on rotation or on translation", "[contact][visibility]") {
  RandomPoints random(2);
  SeeingTriangle seeing(-Vec3(0.2, 0.3, 0.9).normalized());
  seeing.builder.add_grid({6, 6}, 1, [&](double u, double v) { return Vec3(Vec3(2 * u - 1, 2 * v - 1, 1.5 * u * u) + random.point(0.02)); });
  const SurfaceAt s(seeing.builder);
  for (int trial = 0; trial < 30; ++trial) {
    const Vec3 p = Vec3(0, 0, 0.9) + random.point(0.4), offset = random.point(2);
    const Mat3 r = random.rotation();
    const SurfaceAt turned(seeing.builder, moved(seeing.builder.x(), r, offset));
    std::vector<int> order = seeing.others();
    const VisiblePatches visible = find_patches(s, p, order);
    std::reverse(order.begin(), order.end());
    const VisiblePatches other = find_patches(turned, r * p + offset, order);
    REQUIRE(other.count == visible.count);
    for (int k = 0; k < visible.count; ++k) {
      CHECK(other.patches[k].distance == Approx(visible.patches[k].distance));
      CHECK(other.patches[k].area == Approx(visible.patches[k].area));
      CHECK(other.patches[k].overshoot == Approx(visible.patches[k].overshoot).margin(1e-9));
      CHECK((other.patches[k].normal - r * visible.patches[k].normal).norm() < 1e-9);
    }
  }
}

TEST_CASE("a vertex sees patches with the projection of its tributary area, and none from the far side of its plate", "[contact][visibility]") {
  SurfaceBuilder builder;
  builder.add_box({0, 0, 0.1}, {1, 1, 0.2}, 0);
  builder.add_rectangle({1, 1}, 1, {-1, -1, 0}, 3, 3);
  const SurfaceAt s(builder);
  PatchFinder finder(s.surface.mesh, s.lagged);
  double area = 0;
  for (int v = 0; v < 8; ++v) {
    const VisiblePatches visible = finder.find(finder.at_vertex(v), 2, [](int i) { return 12 + i; });
    const bool bottom = builder.x()[3 * v + 2] == 0.1;
    CHECK(visible.count == (bottom ? 1 : 0));
    if (visible.count) area += visible.patches[0].area;
  }
  CHECK(area == Approx(1));
}

TEST_CASE("pins the height over distance from which a surface sees itself", "[contact][visibility]") {
  // Two separate rectangles of one object; the point lies past the boundary of the second one.
  for (const double slope : {0.14, 0.16}) {
    SurfaceBuilder builder;
    builder.add_triangle({0, 0, 0.5}, {0, 1, 0.5}, {1, 0, 0.5}, 0);
    builder.add_rectangle({1, 1}, 0, {1, -1, 0}, 2, 2);
    const SurfaceAt s(builder);
    const double distance = 0.4, height = slope * distance;
    const Vec3 p(1 - std::sqrt(distance * distance - height * height), 0.3, height);
    CHECK(find_patches(s, p, {1, 2}).count == (slope > 0.15 ? 1 : 0));
  }
}

TEST_CASE("pins the angle within which normals are one patch", "[contact][visibility]") {
  for (const double degrees : {49.0, 51.0}) {
    const double angle = degrees / 180 * M_PI;
    SeeingTriangle seeing(down);
    seeing.builder.add_grid({1, 1}, 1, [](double u, double v) { return Vec3(u, v, 0); });
    seeing.builder.add_grid({1, 1}, 1, [=](double u, double v) { return Vec3((u - 1) * std::cos(angle), v, (1 - u) * std::sin(angle)); });
    const SurfaceAt s(seeing.builder);
    CHECK(find_patches(s, {0.2, 0.5, 0.3}, seeing.others()).count == (degrees < 50 ? 1 : 2));
  }
}
