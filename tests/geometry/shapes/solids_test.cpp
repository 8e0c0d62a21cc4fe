#include "geometry/shapes/solids.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/surface.hpp"
#include "geometry/mesh/validate.hpp"
#include "tests/support/closed_surface.hpp"
#include "tests/support/tet_quality.hpp"

using namespace tack;
using std::numbers::pi;

namespace {

double surface_area(const Mesh& mesh) {
  double area = 0;
  for (double a : vertex_areas(mesh, extract_surface(mesh))) area += a;
  return area;
}

double worst_quality(const Mesh& mesh) {
  double worst = 1;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    worst = std::min(worst, tet_quality(mesh, static_cast<int>(t)));
  }
  return worst;
}

void check_solid(const Mesh& mesh) {
  CHECK_NOTHROW(validate_mesh(mesh, "solid"));
  CHECK(inverted_tets(mesh).empty());
  const Surface surface = extract_surface(mesh);
  CHECK(is_closed_manifold(surface.triangles));
  CHECK(euler_characteristic(surface) == 2);
  CHECK(enclosed_volume(mesh, surface.triangles) == Approx(total_volume(mesh)));
}

}  // namespace

TEST_CASE("a box has the documented nodes, tets and volume", "[shapes]") {
  const Vec3 size(0.3, 0.7, 1.1);
  const std::array<int, 3> n = {2, 3, 4};
  const Mesh box = box_tets(size, n);
  check_solid(box);
  CHECK(box.vertices.size() == 3 * 4 * 5);
  CHECK(box.tets.size() == 6 * 2 * 3 * 4);
  CHECK(total_volume(box) == Approx(size.prod()));
  for (int k = 0; k <= n[2]; ++k) {
    for (int j = 0; j <= n[1]; ++j) {
      for (int i = 0; i <= n[0]; ++i) {
        const Vec3 node = -size / 2 + size.cwiseProduct(Vec3(i / 2.0, j / 3.0, k / 4.0));
        CHECK((box.vertices[i + 3 * (j + 4 * k)] - node).norm() < 1e-15);
      }
    }
  }
  CHECK(bounding_box(box).max() == size / 2);
  CHECK(bounding_box(box).min() == -size / 2);
}

TEST_CASE("every tet of a box contains the diagonal of its cell", "[shapes]") {
  const Mesh box = box_tets(Vec3(2, 2, 2), {2, 2, 2});
  for (std::size_t t = 0; t < box.tets.size(); ++t) {
    const int cell = static_cast<int>(t) / 6;
    const int from = cell % 2 + 3 * (cell / 2 % 2 + 3 * (cell / 4)), to = from + 1 + 3 + 9;
    const Tet& tet = box.tets[t];
    CHECK(tet[0] == from);
    CHECK(tet[3] == to);
    CHECK(tet_volume(box, static_cast<int>(t)) == Approx(1.0 / 6));
  }
}

TEST_CASE("a ball converges to its volume and area with good tets", "[shapes]") {
  const double r = 0.5, volume = 4 * pi / 3 * r * r * r, area = 4 * pi * r * r;
  double previous_volume = 1, previous_area = 1;
  for (int cells : {2, 4, 8, 16}) {
    const Mesh ball = sphere(r, cells);
    check_solid(ball);
    CHECK(worst_quality(ball) > 0.65);
    const double volume_error = 1 - total_volume(ball) / volume;
    const double area_error = 1 - surface_area(ball) / area;
    CHECK(volume_error > 0);  // inscribed
    CHECK(volume_error < previous_volume / (cells > 2 ? 3 : 1));
    CHECK(area_error < previous_area / (cells > 2 ? 3 : 1));
    previous_volume = volume_error;
    previous_area = area_error;
    for (int v : extract_surface(ball).vertices) CHECK(ball.vertices[v].norm() == Approx(r));
  }
  CHECK(previous_volume < 0.02);
}

TEST_CASE("a ball's tets are of nearly one size", "[shapes]") {
  const Mesh ball = sphere(1, 12);
  double smallest = 1, largest = 0;
  for (std::size_t t = 0; t < ball.tets.size(); ++t) {
    const double volume = tet_volume(ball, static_cast<int>(t));
    smallest = std::min(smallest, volume);
    largest = std::max(largest, volume);
  }
  CHECK(largest < 1.6 * smallest);
}

TEST_CASE("a cylinder converges to its volume and area with good tets", "[shapes]") {
  const double r = 0.5, h = 1, volume = pi * r * r * h, area = 2 * pi * r * (r + h);
  double previous_volume = 1, previous_area = 1;
  for (int cells : {2, 4, 8, 16}) {
    const Mesh mesh = cylinder(r, h, cells, cells);
    check_solid(mesh);
    CHECK(worst_quality(mesh) > 0.65);
    const double volume_error = 1 - total_volume(mesh) / volume;
    const double area_error = 1 - surface_area(mesh) / area;
    CHECK(volume_error > 0);
    CHECK(volume_error < previous_volume / (cells > 2 ? 3 : 1));
    CHECK(area_error < previous_area / (cells > 2 ? 3 : 1));
    previous_volume = volume_error;
    previous_area = area_error;
  }
  CHECK(previous_volume < 0.01);
  CHECK(bounding_box(cylinder(2, 3, 4, 1)).max().isApprox(Vec3(2, 1.5, 2)));
}

TEST_CASE("voussoirs make an arch with even joints", "[shapes]") {
  const Voussoir stone{0.8, 1.1, 2 * pi / 25, 0.2, 1e-3};
  const Mesh mesh = voussoir(stone, {2, 3, 1});
  check_solid(mesh);
  // A trapezoid between the radii, less the joints.
  const double sine = std::sin(stone.angle / 2), cosine = std::cos(stone.angle / 2);
  const double width = (0.8 + 1.1) / 2 * 2 * sine - 1e-3 * cosine;
  CHECK(total_volume(mesh) == Approx(width * 0.3 * cosine * 0.2));
  // The side faces are half a joint from the planes of the joints.
  const Vec3 normal(cosine, -sine, 0);
  int on_joint = 0;
  for (const Vec3& x : mesh.vertices) {
    CHECK(normal.dot(x) <= -0.5e-3 + 1e-12);
    on_joint += std::abs(normal.dot(x) + 0.5e-3) < 1e-12;
  }
  CHECK(on_joint == 4 * 2);
  CHECK_THROWS_AS(voussoir({0.8, 0.8, 0.1, 0.2, 0}, {1, 1, 1}), InputError);
  CHECK_THROWS_AS(voussoir({0.8, 1.1, pi, 0.2, 0}, {1, 1, 1}), InputError);
  CHECK_THROWS_AS(voussoir({0.8, 1.1, 0.01, 0.2, 0.01}, {1, 1, 1}), InputError);
}

TEST_CASE("solids refuse sizes and cells that make no mesh", "[shapes]") {
  CHECK_THROWS_AS(box_tets(Vec3(1, 0, 1), {1, 1, 1}), InputError);
  CHECK_THROWS_AS(box_tets(Vec3(1, 1, 1), {1, 0, 1}), InputError);
  CHECK_THROWS_AS(box_tets(Vec3(1, 1, 1), {2000, 2000, 2000}), InputError);
  CHECK_THROWS_AS(sphere(-1, 4), InputError);
  CHECK_THROWS_WITH(sphere(1, 5), Catch::Contains("even") && Catch::Contains("4 or 6"));
  CHECK_THROWS_AS(sphere(1, 0), InputError);
  CHECK_THROWS_AS(cylinder(1, 0, 4, 1), InputError);
  CHECK_THROWS_AS(cylinder(1, 1, 3, 1), InputError);
  CHECK_THROWS_AS(cylinder(1, 1, 4, 0), InputError);
}
