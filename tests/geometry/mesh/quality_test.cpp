#include "geometry/mesh/quality.hpp"

#include <catch2/catch.hpp>

#include "tests/support/tet_quality.hpp"

using namespace tack;

TEST_CASE("volume, area and mean ratio have their closed-form values", "[mesh]") {
  Mesh mesh;
  mesh.vertices = {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)};
  mesh.tets = {{0, 1, 2, 3}};  // regular, edge sqrt(8): volume 8/3
  mesh.triangles = {{0, 1, 2}};
  if (tet_volume(mesh, 0) < 0) std::swap(mesh.tets[0][0], mesh.tets[0][1]);
  CHECK(tet_volume(mesh, 0) == Approx(8.0 / 3));
  CHECK(tet_quality(mesh, 0) == Approx(1));
  CHECK(triangle_area(mesh, 0) == Approx(2 * std::sqrt(3.0)));
  CHECK(total_volume(mesh) == Approx(8.0 / 3));
  CHECK(total_area(mesh) == Approx(2 * std::sqrt(3.0)));
  CHECK(inverted_tets(mesh).empty());
}

TEST_CASE("inverted and flat tets are found", "[mesh]") {
  Mesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 0)};
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 1, 2, 4}, {1, 4, 2, 3}};
  CHECK(inverted_tets(mesh) == std::vector<int>{1, 2});
  CHECK(tet_quality(mesh, 1) == -tet_quality(mesh, 0));
  CHECK(tet_quality(mesh, 2) == 0);
  mesh.tets = {{3, 3, 3, 3}};
  CHECK(tet_quality(mesh, 0) == 0);
}
