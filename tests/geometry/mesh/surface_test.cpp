#include "geometry/mesh/surface.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/shapes/lines.hpp"
#include "geometry/shapes/solids.hpp"
#include "geometry/shapes/surfaces.hpp"
#include "tests/support/closed_surface.hpp"

using namespace tack;

TEST_CASE("the surface of one tet is its four faces, outward", "[surface]") {
  Mesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  mesh.tets = {{0, 1, 2, 3}};
  const Surface surface = extract_surface(mesh);
  CHECK(surface.triangles == std::vector<Triangle>{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}});
  CHECK(surface.edges == std::vector<Edge>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}});
  CHECK(surface.vertices == std::vector<int>{0, 1, 2, 3});
  CHECK(surface.codim_edges.empty());
  CHECK(surface.codim_points.empty());
  CHECK(enclosed_volume(mesh, surface.triangles) == Approx(1.0 / 6));
}

TEST_CASE("the surface of a box of tets is closed and encloses its volume", "[surface]") {
  const Mesh mesh = box_tets(Vec3(1, 2, 3), {3, 4, 5});
  const Surface surface = extract_surface(mesh);
  CHECK(is_closed_manifold(surface.triangles));
  CHECK(euler_characteristic(surface) == 2);
  CHECK(enclosed_volume(mesh, surface.triangles) == Approx(6));
  CHECK(surface.triangles.size() == 2 * 2 * (3 * 4 + 4 * 5 + 3 * 5));
  CHECK(surface.vertices.size() == mesh.vertices.size() - 2 * 3 * 4);  // without the inner nodes
}

TEST_CASE("a mesh of all dimensions lists every element once", "[surface]") {
  Mesh mesh;
  mesh.vertices.resize(9, Vec3::Zero());
  mesh.tets = {{0, 1, 2, 3}};
  mesh.triangles = {{1, 2, 3}, {2, 3, 4}};        // the first is a face of the tet
  mesh.edges = {{5, 4}, {4, 3}, {6, 5}, {5, 6}};  // the second is an edge of a triangle
  mesh.points = {8, 0, 6, 8};
  const Surface surface = extract_surface(mesh);
  CHECK(surface.triangles.size() == 5);
  CHECK(surface.triangles.back() == Triangle{2, 3, 4});
  CHECK(surface.edges == std::vector<Edge>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3},
                                           {2, 4}, {3, 4}, {4, 5}, {5, 6}});
  CHECK(surface.codim_edges == std::vector<int>{8, 9});
  CHECK(surface.codim_points == std::vector<int>{8});
  CHECK(surface.vertices == std::vector<int>{0, 1, 2, 3, 4, 5, 6, 8});
}

TEST_CASE("three tets on one face are refused", "[surface]") {
  Mesh mesh;
  mesh.vertices.resize(6, Vec3::Zero());
  mesh.tets = {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 2, 5}};
  CHECK_THROWS_AS(extract_surface(mesh), InputError);
  CHECK_THROWS_WITH(extract_surface(mesh), Catch::Contains("vertices 0 1 2"));
}

TEST_CASE("vertex and edge areas sum up to the area, at every resolution", "[surface]") {
  for (int cells : {1, 2, 7}) {
    const Mesh mesh = grid(Vec2(2, 3), {cells, cells + 1});
    const Surface surface = extract_surface(mesh);
    const auto vertices = vertex_areas(mesh, surface);
    const auto edges = edge_areas(mesh, surface);
    CHECK(vertices.size() == mesh.vertices.size());
    CHECK(edges.size() == surface.edges.size());
    CHECK(std::accumulate(vertices.begin(), vertices.end(), 0.0) == Approx(6));
    CHECK(std::accumulate(edges.begin(), edges.end(), 0.0) == Approx(6));
  }
}

TEST_CASE("an area is a third of each incident triangle", "[surface]") {
  Mesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 3, 0), Vec3(2, 3, 0), Vec3(9, 9, 9)};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  mesh.edges = {{3, 4}};
  const Surface surface = extract_surface(mesh);
  CHECK(vertex_areas(mesh, surface) == std::vector<double>{1, 2, 2, 1, 0});
  // edges 01 02 12 13 23 34
  CHECK(edge_areas(mesh, surface) == std::vector<double>{1, 1, 2, 1, 1, 0});
}

TEST_CASE("a rod and particles have a surface without triangles", "[surface]") {
  const Surface rod = extract_surface(segment(1, 4));
  CHECK(rod.codim_edges == std::vector<int>{0, 1, 2, 3});
  CHECK(rod.vertices.size() == 5);
  const Surface particles = extract_surface(point_grid(Vec3(1, 1, 1), {2, 2, 2}));
  CHECK(particles.codim_points.size() == 8);
  CHECK(particles.vertices.size() == 8);
  CHECK(particles.edges.empty());
}
