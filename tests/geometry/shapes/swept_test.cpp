// Swept shapes against closed forms: exactly for the polygon that replaces a circle, in the limit for the circle.
#include "geometry/shapes/swept.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/surface.hpp"
#include "geometry/mesh/validate.hpp"
#include "geometry/meshing/triangulate.hpp"
#include "tests/support/closed_surface.hpp"

using namespace tack;
using Catch::Contains;

namespace {

constexpr double pi = std::numbers::pi;

std::vector<Vec2> arc(const Vec2& centre, double radius, double from, double to, int pieces) {
  std::vector<Vec2> points;
  for (int i = 0; i <= pieces; ++i) {
    const double a = from + (to - from) * i / pieces;
    points.emplace_back(centre.x() + radius * std::cos(a), centre.y() + radius * std::sin(a));
  }
  return points;
}

std::vector<Vec2> ring(const Vec2& centre, double radius, int corners) {
  std::vector<Vec2> points = arc(centre, radius, 0, 2 * pi, corners);
  points.pop_back();
  return points;
}

double flat_area(const FlatMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec2 u = mesh.vertices[b] - mesh.vertices[a], v = mesh.vertices[c] - mesh.vertices[a];
    CHECK(u.x() * v.y() - u.y() * v.x() > 0);
    sum += (u.x() * v.y() - u.y() * v.x()) / 2;
  }
  return sum;
}

// Positive tets whose surface is a closed manifold of that Euler characteristic.
void check_solid(const Mesh& mesh, double volume, int euler, double within = 1e-12) {
  CHECK_NOTHROW(validate_mesh(mesh, "solid"));
  CHECK(inverted_tets(mesh).empty());
  CHECK(total_volume(mesh) == Approx(volume).epsilon(within));
  const Surface surface = extract_surface(mesh);
  CHECK(is_closed_manifold(surface.triangles));
  CHECK(euler_characteristic(surface) == euler);
  CHECK(enclosed_volume(mesh, surface.triangles) == Approx(volume).epsilon(within));
}

}  // namespace

TEST_CASE("profiles are divided segment by segment", "[shapes]") {
  CHECK(divided({{0, 0}, {3, 0}, {3, 1}}, false, 4).size() == 5);
  CHECK(divided({{0, 0}, {3, 0}, {3, 1}}, false, 4)[1] == Vec2(1, 0));
  CHECK(divided({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, true, 8).size() == 8);
  CHECK(divided({{0, 0}, {1000, 0}, {1000, 1}}, false, 3).size() == 5);  // a corner stays one
}

TEST_CASE("a cone has the area of its polygon, and in the limit that of a cone", "[shapes]") {
  for (const double unit : {1e-3, 1.0, 1e3}) {
    const double r = 0.6 * unit, h = 0.8 * unit;
    const Mesh cone = revolved_sheet(divided({{r, 0}, {0, h}}, false, 5), 2 * pi, 24);
    // Area of a pyramid: 24 triangles over the chords.
    const double chord = 2 * r * std::sin(pi / 24), slant = std::hypot(h, r * std::cos(pi / 24));
    CHECK(total_area(cone) == Approx(24 * chord * slant / 2).epsilon(1e-12));
    CHECK(cone.vertices.size() == 5 * 24 + 1);
    CHECK(cone.triangles.size() == 24 + 4 * 2 * 24);
    CHECK(cone.tags.empty());
    // Normals outwards of a profile that runs up.
    for (const auto& [a, b, c] : cone.triangles) {
      const Vec3 normal = (cone.vertices[b] - cone.vertices[a]).cross(cone.vertices[c] - cone.vertices[a]);
      CHECK(normal.dot(Vec3(cone.vertices[a].x() + cone.vertices[b].x(), 0, cone.vertices[a].z() + cone.vertices[b].z())) > 0);
    }
  }
  const auto error = [](int n) { return std::abs(total_area(revolved_sheet({{0.6, 0}, {0, 0.8}}, 2 * pi, n)) / (pi * 0.6) - 1); };
  CHECK(error(64) < 1e-3);
  CHECK(error(32) / error(64) == Approx(4).epsilon(0.02));
}

TEST_CASE("a sphere of one profile is closed, with its area and volume in the limit", "[shapes]") {
  const auto ball = [](int n) { return revolved_sheet(arc({0, 0}, 1, -pi / 2, pi / 2, n), 2 * pi, 2 * n); };
  const Mesh mesh = ball(16);
  CHECK(is_closed_manifold(mesh.triangles));
  CHECK(euler_characteristic(extract_surface(mesh)) == 2);
  CHECK(enclosed_volume(mesh, mesh.triangles) > 0);
  const auto area_error = [&](int n) { return 1 - total_area(ball(n)) / (4 * pi); };
  const auto volume_error = [&](int n) { return 1 - enclosed_volume(ball(n), ball(n).triangles) / (4 * pi / 3); };
  CHECK(area_error(32) < 2.1e-3);
  CHECK(area_error(16) / area_error(32) == Approx(4).epsilon(0.02));
  CHECK(volume_error(16) / volume_error(32) == Approx(4).epsilon(0.02));
}

TEST_CASE("a torus: a sheet along a loop has no duplicate vertices, and Pappus' area", "[shapes]") {
  const Mesh torus = revolved_sheet(arc({3, 0}, 1, 0, 2 * pi, 64), 2 * pi, 128);
  CHECK(torus.vertices.size() == 64 * 128);
  CHECK(is_closed_manifold(torus.triangles));
  CHECK(euler_characteristic(extract_surface(torus)) == 0);
  CHECK(enclosed_volume(torus, torus.triangles) == Approx(2 * pi * pi * 3).epsilon(2.1e-3));
  CHECK(total_area(torus) == Approx(4 * pi * pi * 3).epsilon(2e-3));
}

TEST_CASE("solids of revolution have Pappus' volume, for full and partial turns", "[shapes]") {
  for (const double unit : {1e-3, 1.0, 1e3}) {
    // The section is 2 by 1, its centroid 3 from the axis: n sin(2 pi / n) / (2 pi) of Pappus' volume.
    const std::vector<Vec2> section = divided({unit * Vec2(2, 0), unit * Vec2(4, 0), unit * Vec2(4, 1), unit * Vec2(2, 1)}, true, 12);
    const FlatMesh flat = triangulate(section, 0.7 * unit, "section");
    CHECK(flat_area(flat) == Approx(2 * unit * unit).epsilon(1e-12));
    const auto volume = [&](double angle, int n) { return 2 * 3 * n * std::sin(angle / n) * std::pow(unit, 3); };
    check_solid(revolved_solid(flat, 2 * pi, 17), volume(2 * pi, 17), 0);
    check_solid(revolved_solid(flat, 2 * pi, 3), volume(2 * pi, 3), 0);
    const Mesh part = revolved_solid(flat, 1.5, 5);
    check_solid(part, volume(1.5, 5), 2);
    REQUIRE(part.tags.size() == 2);
    for (const int v : part.tags.at("start")) CHECK(std::abs(part.vertices[v].z()) < 1e-12 * unit);
    for (const int v : part.tags.at("end"))
      CHECK(std::atan2(-part.vertices[v].z(), part.vertices[v].x()) == Approx(1.5));
  }
  // On the axis prisms degenerate: a cylinder, a ball, and a quarter of a ball.
  const FlatMesh half = triangulate(divided({{0, -1}, {1, -1}, {1, 1}, {0, 1}}, true, 12), 0.5, "half");
  check_solid(revolved_solid(half, 2 * pi, 24), 24 * std::sin(2 * pi / 24), 2);
  check_solid(revolved_solid(half, pi / 2, 6), 6 * std::sin(pi / 12), 2);
  const FlatMesh disc = triangulate(divided(arc({0, 0}, 1, -pi / 2, pi / 2, 48), true, 64), 0.2, "disc");
  check_solid(revolved_solid(disc, 2 * pi, 96), 4 * pi / 3, 2, 4e-3);
  // A torus in the limit.
  const FlatMesh round = triangulate(ring({3, 0}, 1, 64), 0.3, "ring");
  check_solid(revolved_solid(round, 2 * pi, 128), 2 * pi * pi * 3, 0, 3e-3);
}

TEST_CASE("an extrusion has the profile's length, or area, times the length of the path", "[shapes]") {
  const std::vector<Vec2> channel = {{0, 1}, {0, 0}, {2, 0}, {2, 1}};
  const Mesh sheet = extruded_sheet(divided(channel, false, 8), 3, 6);
  CHECK(total_area(sheet) == Approx(4 * 3.0));
  CHECK(sheet.vertices.size() == 9 * 7);
  for (const int v : sheet.tags.at("start")) CHECK(sheet.vertices[v].z() == 1.5);
  for (const int v : sheet.tags.at("end")) CHECK(sheet.vertices[v].z() == -1.5);
  // Normals point to the right of the path.
  const Mesh up = extruded_sheet({{0, 0}, {0, 1}}, 1, 1);
  for (const auto& [a, b, c] : up.triangles) CHECK((up.vertices[b] - up.vertices[a]).cross(up.vertices[c] - up.vertices[a]).x() > 0);
  const Mesh tube = extruded_sheet(arc({0, 0}, 1, 0, 2 * pi, 40), 2, 5);
  CHECK(tube.vertices.size() == 40 * 6);
  CHECK(total_area(tube) == Approx(2 * 40 * 2 * std::sin(pi / 40)));
  // A clockwise polygon that is not convex.
  const std::vector<Vec2> angle = {{0, 1}, {0.1, 1}, {0.1, 0.1}, {1, 0.1}, {1, 0}, {0, 0}};
  const Mesh beam = extruded_solid(triangulate(divided(angle, true, 40), 0.1, "angle"), 3, 20);
  check_solid(beam, 0.19 * 3, 2);
}

TEST_CASE("profiles that cannot be swept are refused with the position", "[shapes]") {
  CHECK_THROWS_WITH(revolved_sheet({{-1, 0}, {1, 1}}, 2 * pi, 8), Contains("crosses the axis") && Contains("(-1, 0)"));
  CHECK_THROWS_WITH(revolved_sheet({{1, 0}, {0, 1}, {1, 2}}, 2 * pi, 8), Contains("touches the axis at (0, 1)"));
  CHECK_THROWS_WITH(revolved_sheet({{0, 0}, {0, 1}}, 2 * pi, 8), Contains("touches the axis"));
  CHECK_THROWS_WITH(revolved_sheet({{1, 0}, {2, 1}}, 2 * pi, 2), Contains("at least 3"));
  CHECK_THROWS_WITH(revolved_sheet({{1, 0}, {2, 1}}, pi, 1), Contains("at least 2"));
  CHECK_THROWS_WITH(revolved_sheet({{1, 0}, {2, 1}}, 7, 20), Contains("more than a turn"));
  CHECK_THROWS_WITH(extruded_sheet({{1, 0}, {2, 1}}, 0, 20), Contains("length"));
  CHECK_THROWS_WITH(extruded_sheet({{1, 0}}, 1, 20), Contains("two points"));
  CHECK_THROWS_WITH(triangulate({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 0.5, "bow"), Contains("bow") && Contains("cross"));
  CHECK_THROWS_WITH(triangulate({{0, 0}, {1, 1}}, 0.5, "line"), Contains("three corners"));
  CHECK_THROWS_WITH(triangulate({{0, 0}, {1, 0}, {0, 1}}, 1e-9, "fine"), Contains("triangles"));
  const FlatMesh touching = triangulate({{0, 0}, {1, -1}, {1, 1}}, 0.5, "touching");
  CHECK_THROWS_WITH(revolved_solid(touching, 2 * pi, 8), Contains("touches the axis"));
}

TEST_CASE("sections have no thin triangles", "[shapes]") {
  const FlatMesh mesh = triangulate(ring({0, 0}, 1, 50), 0.15, "disc");
  CHECK(flat_area(mesh) == Approx(25 * std::sin(2 * pi / 50)).epsilon(1e-12));
  double smallest = pi, longest = 0;
  for (const Triangle& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const Vec2 u = mesh.vertices[t[(i + 1) % 3]] - mesh.vertices[t[i]], v = mesh.vertices[t[(i + 2) % 3]] - mesh.vertices[t[i]];
      smallest = std::min(smallest, std::acos(u.dot(v) / (u.norm() * v.norm())));
      longest = std::max(longest, u.norm());
    }
  CHECK(smallest > 20 * pi / 180);
  CHECK(longest <= 0.15 * (1 + 1e-12));
}
