#include "geometry/shapes/lines.hpp"

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "geometry/mesh/validate.hpp"

using namespace tack;

TEST_CASE("a segment is a chain of edges along x", "[shapes]") {
  const Mesh rod = segment(2, 4);
  CHECK_NOTHROW(validate_mesh(rod, "rod"));
  CHECK(rod.vertices.size() == 5);
  CHECK(rod.vertices.front() == Vec3(-1, 0, 0));
  CHECK(rod.vertices.back() == Vec3(1, 0, 0));
  CHECK(rod.edges == std::vector<Edge>{{0, 1}, {1, 2}, {2, 3}, {3, 4}});
  CHECK_THROWS_AS(segment(0, 4), InputError);
  CHECK_THROWS_AS(segment(1, 0), InputError);
}

TEST_CASE("a point grid numbers its particles x first", "[shapes]") {
  const Mesh points = point_grid(Vec3(2, 0, 6), {3, 1, 4});
  CHECK_NOTHROW(validate_mesh(points, "points"));
  CHECK(points.points.size() == 12);
  CHECK(points.vertices[0] == Vec3(-1, 0, -3));
  CHECK(points.vertices[2 + 3 * 1] == Vec3(1, 0, -1));
  CHECK(points.vertices[11] == Vec3(1, 0, 3));
  CHECK_THROWS_AS(point_grid(Vec3(1, 0, 1), {2, 2, 2}), InputError);
  CHECK_THROWS_AS(point_grid(Vec3(1, 1, 1), {0, 2, 2}), InputError);
}
