#include "geometry/mesh/mesh.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <numbers>

#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"

using namespace tack;

namespace {

Mesh corner_tet() {
  Mesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.tags["tip"] = {3};
  return mesh;
}

}  // namespace

TEST_CASE("a mesh is translated, and its bounding box with it", "[mesh]") {
  Mesh mesh = corner_tet();
  translate(mesh, Vec3(1, 2, 3));
  CHECK(mesh.vertices[1] == Vec3(2, 2, 3));
  CHECK(bounding_box(mesh).min() == Vec3(1, 2, 3));
  CHECK(bounding_box(mesh).max() == Vec3(2, 3, 4));
  CHECK(bounding_box(Mesh()).isEmpty());
}

TEST_CASE("rotation is right-handed about an axis of any length", "[mesh]") {
  Mesh mesh = corner_tet();
  rotate(mesh, Vec3(0, 0, 5), std::numbers::pi / 2);
  CHECK((mesh.vertices[1] - Vec3(0, 1, 0)).norm() < 1e-15);
  CHECK((mesh.vertices[2] - Vec3(-1, 0, 0)).norm() < 1e-15);
  CHECK(total_volume(mesh) == Approx(1.0 / 6));
}

TEST_CASE("mirroring keeps tets positive and triangle normals on their side", "[mesh]") {
  Mesh mesh = corner_tet();
  mesh.triangles = {{0, 1, 2}};  // normal +z
  scale(mesh, Vec3(-2, 1, 1));
  CHECK(total_volume(mesh) == Approx(2.0 / 6));
  const auto& [a, b, c] = mesh.triangles[0];
  const auto& x = mesh.vertices;
  CHECK((x[b] - x[a]).cross(x[c] - x[a]).z() > 0);
  scale(mesh, Vec3(-1, -1, 1));
  CHECK(total_volume(mesh) == Approx(2.0 / 6));
}

TEST_CASE("appending shifts indices and unites groups", "[mesh]") {
  Mesh mesh = corner_tet();
  Mesh other = corner_tet();
  other.triangles = {{0, 2, 1}};
  other.edges = {{2, 3}};
  other.points = {0};
  other.tags["root"] = {0};
  append(mesh, other);
  CHECK(mesh.vertices.size() == 8);
  CHECK(mesh.tets == std::vector<Tet>{{0, 1, 2, 3}, {4, 5, 6, 7}});
  CHECK(mesh.triangles == std::vector<Triangle>{{4, 6, 5}});
  CHECK(mesh.edges == std::vector<Edge>{{6, 7}});
  CHECK(mesh.points == std::vector<int>{4});
  CHECK(mesh.tags["tip"] == std::vector<int>{3, 7});
  CHECK(mesh.tags["root"] == std::vector<int>{4});
  append(mesh, mesh);
  CHECK(mesh.vertices.size() == 16);
  CHECK(mesh.tets[3] == Tet{12, 13, 14, 15});
}

TEST_CASE("transforms that would spoil a mesh are refused", "[mesh]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Mesh mesh = corner_tet();
  CHECK_THROWS_AS(translate(mesh, Vec3(nan, 0, 0)), InputError);
  CHECK_THROWS_AS(rotate(mesh, Vec3::Zero(), 1), InputError);
  CHECK_THROWS_AS(rotate(mesh, Vec3::UnitX(), nan), InputError);
  CHECK_THROWS_AS(scale(mesh, Vec3(1, 0, 1)), InputError);
  CHECK_THROWS_AS(scale(mesh, Vec3(1, nan, 1)), InputError);
  CHECK(mesh.vertices == corner_tet().vertices);
}
