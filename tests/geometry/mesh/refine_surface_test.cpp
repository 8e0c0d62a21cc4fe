#include "geometry/mesh/refine_surface.hpp"

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/shapes/solids.hpp"
#include "tests/support/closed_surface.hpp"

using namespace tack;

namespace {

struct Refined {
  Mesh mesh;  // with all vertices, triangles alone
  RefinedSurface surface;
};

Refined refined(const Mesh& mesh, double edge_length) {
  Refined r;
  r.surface = refine_surface(mesh.vertices, extract_surface(mesh).triangles, edge_length);
  r.mesh.vertices = mesh.vertices;
  for (const auto& on : r.surface.added) {
    Vec3 x = Vec3::Zero();
    for (const auto& [v, weight] : on) x += weight * mesh.vertices[v];
    r.mesh.vertices.push_back(x);
  }
  r.mesh.triangles = r.surface.triangles;
  return r;
}

double area_of(const Mesh& mesh, const std::vector<Triangle>& triangles) {
  double area = 0;
  for (const auto& [a, b, c] : triangles) area += triangle_area(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  return area;
}

double longest_edge(const Mesh& mesh) {
  double longest = 0;
  for (const Edge& e : extract_surface(mesh).edges)
    longest = std::max(longest, (mesh.vertices[e[0]] - mesh.vertices[e[1]]).norm());
  return longest;
}

Mesh one_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  Mesh mesh;
  mesh.vertices = {a, b, c};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

}  // namespace

TEST_CASE("a refined surface stays closed, keeps area, volume and orientation, and has no longer edges", "[surface]") {
  for (const Mesh& mesh : {box_tets(Vec3(1, 2, 3), {1, 1, 1}), box_tets(Vec3(1, 0.1, 0.3), {2, 1, 3}), sphere(0.5, 4)})
    for (const double edge_length : {5.0, 0.7, 0.3, 0.11}) {
      INFO("edges of " << edge_length);
      const Refined r = refined(mesh, edge_length);
      const Surface surface = extract_surface(r.mesh);
      const auto old = extract_surface(mesh).triangles;
      CHECK(is_closed_manifold(r.mesh.triangles));
      CHECK(surface.vertices.size() + r.surface.triangles.size() - surface.edges.size() == 2);
      CHECK(area_of(r.mesh, r.mesh.triangles) == Approx(area_of(mesh, old)).epsilon(1e-13));
      CHECK(enclosed_volume(r.mesh, r.mesh.triangles) == Approx(enclosed_volume(mesh, old)).epsilon(1e-13));
      CHECK(longest_edge(r.mesh) <= edge_length * (1 + 1e-9));
      CHECK((r.mesh.triangles == old) == (longest_edge(mesh) <= edge_length));
    }
}

TEST_CASE("a triangle with one, two or three long edges is divided into two, three or four", "[surface]") {
  const auto parts = [](const Mesh& mesh) { return refined(mesh, 1).surface; };
  CHECK(parts(one_triangle({0, 0, 0}, {0.9, 0, 0}, {0, 0.4, 0})).triangles == std::vector<Triangle>{{0, 1, 2}});
  const RefinedSurface two = parts(one_triangle({0, 0, 0}, {0.9, 0, 0}, {0, 0.9, 0}));
  CHECK(two.triangles == std::vector<Triangle>{{1, 3, 0}, {3, 2, 0}});
  CHECK(two.added == std::vector<std::vector<std::pair<int, double>>>{{{1, 0.5}, {2, 0.5}}});
  CHECK(parts(one_triangle({0, 0, 0}, {0.2, 0, 0}, {0.1, 1.5, 0})).triangles.size() == 3);
  CHECK(parts(one_triangle({0, 0, 0}, {1.2, 0, 0}, {0, 1.2, 0})).triangles.size() == 4);
}

TEST_CASE("new vertices lie in the triangle or edge whose corners they depend on", "[surface]") {
  const Mesh mesh = sphere(0.5, 2);
  const Surface surface = extract_surface(mesh);
  for (const auto& on : refined(mesh, 0.06).surface.added) {
    double sum = 0;
    std::vector<int> corners;
    for (const auto& [v, weight] : on) {
      CHECK(weight > 0);
      sum += weight;
      corners.push_back(v);
    }
    CHECK(sum == 1);
    REQUIRE((corners.size() == 2 || corners.size() == 3));
    const auto holds = [&](const Triangle& t) {
      return std::all_of(corners.begin(), corners.end(), [&](int v) { return std::count(t.begin(), t.end(), v) == 1; });
    };
    CHECK(std::any_of(surface.triangles.begin(), surface.triangles.end(), holds));
  }
}

TEST_CASE("too short edges are refused before the division", "[surface]") {
  const Mesh mesh = box_tets(Vec3(1, 1, 1), {1, 1, 1});
  CHECK_THROWS_WITH(refined(mesh, 1e-9), Catch::Contains("more than 1000000 new vertices"));
  CHECK_NOTHROW(refine_surface(mesh.vertices, extract_surface(mesh).triangles, 0.8, 18));
  CHECK_THROWS_AS(refine_surface(mesh.vertices, extract_surface(mesh).triangles, 0.8, 17), InputError);
}
