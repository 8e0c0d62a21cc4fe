#include "geometry/shapes/rounded_box.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/surface.hpp"
#include "geometry/mesh/validate.hpp"
#include "geometry/shapes/solids.hpp"
#include "geometry/shapes/surfaces.hpp"
#include "tests/support/closed_surface.hpp"

using namespace tack;
using Catch::Matchers::Contains;

namespace {

const Vec3 size(0.13, 0.08, 0.2);

// Returns the distance from a box that is smaller by `rounding` on every side.
double distance_to_core(const Vec3& x, double rounding) {
  const Vec3 inner = size / 2 - Vec3::Constant(rounding);
  return (x - x.cwiseMax(-inner).cwiseMin(inner)).norm();
}

// The Steiner formula of a box, and of its surface.
double exact_volume(double r) {
  const Vec3 a = size - Vec3::Constant(2 * r);
  const double pi = std::numbers::pi;
  return a.prod() + 2 * r * (a[0] * a[1] + a[1] * a[2] + a[2] * a[0]) + pi * r * r * a.sum() + 4 * pi / 3 * r * r * r;
}

}  // namespace

TEST_CASE("a rounded box: its vertices are on the exact surface, and its area converges", "[shapes]") {
  const double rounding = GENERATE(0.01, 0.02, 0.04);
  const std::array<int, 3> cells = {52, 32, 80};
  Mesh surface = box_surface(size, cells), solid = box_tets(size, cells);
  round_box(surface, size, cells, rounding);
  round_box(solid, size, cells, rounding);
  CHECK(enclosed_volume(surface, surface.triangles) == Approx(exact_volume(rounding)).epsilon(4e-3));
  CHECK(total_volume(solid) == Approx(exact_volume(rounding)).epsilon(4e-3));
  CHECK_NOTHROW(validate_mesh(solid, "box"));
  CHECK(inverted_tets(solid).empty());
  const Surface outside = extract_surface(solid);
  CHECK(is_closed_manifold(outside.triangles));
  for (const Mesh* mesh : {&surface, &solid}) {
    double worst = 0;
    for (const Triangle& t : mesh == &surface ? surface.triangles : outside.triangles)
      for (int i = 0; i < 3; ++i) worst = std::max(worst, std::abs(distance_to_core(mesh->vertices[size_t(t[i])], rounding) - rounding));
    CHECK(worst < 1e-15);
  }
}

TEST_CASE("a rounded box: sides stay flat, coarse cells do not turn over", "[shapes]") {
  const std::array<int, 3> cells = {7, 4, 10};
  Mesh solid = box_tets(size, cells);
  round_box(solid, size, cells, 0.02);
  CHECK(inverted_tets(solid).empty());
  CHECK(bounding_box(solid).max() == size / 2);
  CHECK(bounding_box(solid).min() == -size / 2);
}

TEST_CASE("a rounded box: roundings that do not fit are refused; zero rounding has no effect", "[shapes]") {
  Mesh box = box_surface(size, {7, 4, 10});
  const auto before = box.vertices;
  round_box(box, size, {7, 4, 10}, 0);
  CHECK(box.vertices == before);
  CHECK_THROWS_WITH(round_box(box, size, {7, 4, 10}, 0.041), Contains("half of its shortest side, 0.04 m"));
  CHECK_THROWS_WITH(round_box(box, size, {7, 4, 10}, -0.01), Contains("rounding is -0.01 m"));
  CHECK_THROWS_WITH(round_box(box, size, {7, 4, 9}, 0.02), Contains("along z") && Contains("use at least 10"));
}
