#include "geometry/mesh/validate.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <limits>

#include "geometry/errors.hpp"

using namespace tack;
using Catch::Matchers::Contains;

namespace {

// A tet, a triangle, a rod and a particle: valid.
Mesh valid() {
  Mesh mesh;
  for (int i = 0; i < 10; ++i) mesh.vertices.emplace_back(i, i * i, i * i * i);
  mesh.tets = {{0, 1, 2, 3}};
  mesh.triangles = {{4, 5, 6}};
  mesh.edges = {{7, 8}};
  mesh.points = {9};
  mesh.tags["all"] = {0, 9};
  return mesh;
}

void check_refused(const std::function<void(Mesh&)>& spoil, const std::string& message) {
  Mesh mesh = valid();
  spoil(mesh);
  INFO(message);
  CHECK_THROWS_AS(validate_mesh(mesh, "part.msh"), InputError);
  CHECK_THROWS_WITH(validate_mesh(mesh, "part.msh"), Contains("part.msh") && Contains(message));
}

}  // namespace

TEST_CASE("a valid mesh of all dimensions passes", "[mesh]") {
  CHECK_NOTHROW(validate_mesh(valid(), "part.msh"));
}

TEST_CASE("each flaw of a mesh is named with the element and the remedy", "[mesh]") {
  check_refused([](Mesh& m) { m = Mesh(); }, "no element");
  check_refused([](Mesh& m) { m.tets[0][1] = 10; },
                "tet 0 (vertices 0 10 2 3) refers to vertex 10");
  check_refused([](Mesh& m) { m.edges[0][1] = -1; }, "edge 0 (vertices 7 -1) refers to vertex -1");
  check_refused([](Mesh& m) { m.points[0] = 99; }, "point 0 (vertices 99)");
  check_refused([](Mesh& m) { m.tags["all"] = {0, 12}; }, "group \"all\" refers to vertex 12");
  check_refused([](Mesh& m) { m.vertices[3].y() = std::numeric_limits<double>::infinity(); },
                "vertex 3 is at (3, inf, 27)");
  check_refused([](Mesh& m) { m.triangles.push_back({4, 5, 4}); },
                "triangle 1 (vertices 4 5 4) uses a vertex twice");
  check_refused([](Mesh& m) { std::swap(m.tets[0][0], m.tets[0][1]); },
                "inverted (volume -2 m^3): swap two");
  check_refused([](Mesh& m) { m.vertices[3] = m.vertices[1] + m.vertices[2]; },
                "tet 0 (vertices 0 1 2 3) is flat");
  check_refused([](Mesh& m) { m.vertices[6] = 2 * m.vertices[5] - m.vertices[4]; },
                "triangle 0 (vertices 4 5 6) has no area");
  check_refused([](Mesh& m) { m.vertices[8] = m.vertices[7]; },
                "edge 0 (vertices 7 8) has no length");
  check_refused([](Mesh& m) { m.points.clear(); m.tags.clear(); },
                "vertex 9 belongs to no element (1 such vertices): remove");
  check_refused([](Mesh& m) { m.triangles.push_back({6, 5, 4}); },
                "triangle 0 (vertices 4 5 6) and triangle 1 (vertices 6 5 4) are the same: remove one of them");
  check_refused([](Mesh& m) { m.edges.push_back({8, 7}); }, "edge 0 (vertices 7 8) and edge 1 (vertices 8 7) are the same: remove one of them");
}

TEST_CASE("triangles on faces of tets, and edges of both, may be listed twice", "[mesh]") {
  Mesh mesh = valid();
  mesh.triangles.insert(mesh.triangles.end(), {{2, 0, 1}, {0, 1, 2}, {3, 1, 2}});
  mesh.edges.insert(mesh.edges.end(), {{0, 3}, {3, 0}, {4, 5}, {5, 4}});
  CHECK_NOTHROW(validate_mesh(mesh, "part.msh"));
}

TEST_CASE("flatness is relative to the size of the element", "[mesh]") {
  Mesh mesh = valid();
  for (Vec3& x : mesh.vertices) x *= 1e-9;
  CHECK_NOTHROW(validate_mesh(mesh, "small"));
}
