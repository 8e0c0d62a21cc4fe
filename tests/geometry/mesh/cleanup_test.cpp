#include "geometry/mesh/cleanup.hpp"

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"

using namespace tack;

TEST_CASE("equal vertices merge in order of first use, also +0 and -0", "[mesh]") {
  Mesh mesh;
  mesh.vertices = {Vec3(1, 0, 0), Vec3(0, 0.0, 0), Vec3(1, 0, 0),
                   Vec3(0, 1, 0), Vec3(0, -0.0, 0), Vec3(1, 0, 1e-9)};
  mesh.triangles = {{0, 3, 1}, {2, 4, 5}, {0, 2, 3}};
  mesh.edges = {{1, 4}, {4, 5}};
  mesh.points = {4, 1};
  mesh.tags["group"] = {0, 2, 5};
  merge_duplicate_vertices(mesh);
  CHECK(mesh.vertices == std::vector<Vec3>{Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(0, 1, 0),
                                           Vec3(1, 0, 1e-9)});
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}});  // one collapsed
  CHECK(mesh.edges == std::vector<Edge>{{1, 3}});
  CHECK(mesh.points == std::vector<int>{1});
  CHECK(mesh.tags["group"] == std::vector<int>{0, 3});
}

TEST_CASE("vertices within the tolerance merge across the cells of the hash grid", "[mesh]") {
  Mesh mesh;
  mesh.vertices = {Vec3(0.0999, 0, 0), Vec3(0.1001, 0, 0), Vec3(-0.001, 0, 0), Vec3(0.1, 0.11, 0)};
  mesh.edges = {{0, 3}, {1, 2}};
  merge_duplicate_vertices(mesh, 0.1);
  // 2 is 0.1009 from 0, hence kept; 3 is 0.11 away; 1 becomes 0.
  CHECK(mesh.vertices.size() == 3);
  CHECK(mesh.edges == std::vector<Edge>{{0, 2}, {0, 1}});
  CHECK_THROWS_AS(merge_duplicate_vertices(mesh, -1), InputError);
}

TEST_CASE("faces and edges of other elements are dropped, others stay", "[mesh]") {
  Mesh mesh;
  mesh.vertices.resize(8, Vec3::Zero());
  mesh.tets = {{0, 1, 2, 3}};
  mesh.triangles = {{2, 1, 0}, {3, 4, 2}};
  mesh.edges = {{3, 0}, {4, 3}, {4, 5}};
  mesh.points = {5, 6, 0};
  drop_redundant_elements(mesh);
  CHECK(mesh.triangles == std::vector<Triangle>{{3, 4, 2}});
  CHECK(mesh.edges == std::vector<Edge>{{4, 5}});
  CHECK(mesh.points == std::vector<int>{6});
}

TEST_CASE("unused vertices are removed and the others renumbered", "[mesh]") {
  Mesh mesh;
  for (int i = 0; i < 5; ++i) mesh.vertices.emplace_back(i, 0, 0);
  mesh.edges = {{1, 4}};
  mesh.points = {3};
  mesh.tags["group"] = {0, 1, 3};
  drop_unused_vertices(mesh);
  CHECK(mesh.vertices == std::vector<Vec3>{Vec3(1, 0, 0), Vec3(3, 0, 0), Vec3(4, 0, 0)});
  CHECK(mesh.edges == std::vector<Edge>{{0, 2}});
  CHECK(mesh.points == std::vector<int>{1});
  CHECK(mesh.tags["group"] == std::vector<int>{0, 1});
}
