#include "geometry/tets/divide_tets.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <set>

#include "geometry/mesh/surface.hpp"
#include "geometry/mesh/validate.hpp"
#include "geometry/shapes/solids.hpp"
#include "geometry/tet_edges.hpp"

using namespace tack;

namespace {

double volume(const Mesh& mesh, const Tet& t) {
  return edges_of({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]}).determinant() / 6;
}

}  // namespace

TEST_CASE("divided tets: eight positive tets of an eighth of the volume each, conforming faces, old vertices first", "[divide_tets]") {
  for (const Mesh& mesh : {box_tets({1, 0.7, 0.4}, {3, 2, 2}), sphere(1, 4), voussoir({}, {2, 2, 2})}) {
    const Mesh fine = divide_tets(mesh);
    REQUIRE(fine.tets.size() == 8 * mesh.tets.size());
    for (size_t t = 0; t < fine.tets.size(); ++t) {
      const double whole = volume(mesh, mesh.tets[t / 8]);
      CHECK(volume(fine, fine.tets[t]) == Approx(whole / 8).epsilon(1e-9));
    }
    CHECK(std::equal(mesh.vertices.begin(), mesh.vertices.end(), fine.vertices.begin()));
    CHECK_NOTHROW(validate_mesh(fine, "fine"));
    const Surface before = extract_surface(mesh), after = extract_surface(fine);
    CHECK(after.triangles.size() == 4 * before.triangles.size());
    // No two vertices at one position: middles are shared.
    std::set<std::array<long, 3>> positions;
    for (const Vec3& x : fine.vertices) positions.insert({std::lround(1e7 * x.x()), std::lround(1e7 * x.y()), std::lround(1e7 * x.z())});
    CHECK(positions.size() == fine.vertices.size());
  }
}

TEST_CASE("divided tets: composite nodes are recovered, the diagonal is the shortest", "[divide_tets]") {
  const Mesh mesh = sphere(1, 4), fine = divide_tets(mesh);
  const std::vector<CompositeTet> tets = composite_tets_of(fine.tets);
  REQUIRE(tets.size() == mesh.tets.size());
  for (size_t t = 0; t < tets.size(); ++t) {
    const CompositeTet& nodes = tets[t];
    CHECK(std::is_permutation(nodes.begin(), nodes.begin() + 4, mesh.tets[t].begin()));
    for (size_t e = 0; e < composite_edges.size(); ++e) {
      const auto& [a, b] = composite_edges[e];
      CHECK((fine.vertices[nodes[4 + e]] - (fine.vertices[nodes[a]] + fine.vertices[nodes[b]]) / 2).norm() <= 1e-15);
    }
    const auto length = [&](int i, int k) { return (fine.vertices[nodes[i]] - fine.vertices[nodes[k]]).norm(); };
    CHECK(length(4, 9) <= (1 + 1e-5) * std::min(length(5, 8), length(6, 7)));
  }
}

TEST_CASE("divided tets: a rotated, translated and scaled mesh has the same division", "[divide_tets]") {
  const Mesh mesh = box_tets({1, 1, 1}, {2, 2, 2});  // of many ties
  Mesh turned = mesh;
  rotate(turned, {0.3, 1, 0.2}, 0.7);
  translate(turned, {1e3, -20, 5});
  scale(turned, {1e-3, 1e-3, 1e-3});
  CHECK(divide_tets(turned).tets == divide_tets(mesh).tets);
}

TEST_CASE("divided tets: triangles, edges, points and groups of the mesh are divided with them", "[divide_tets]") {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {2, 0, 0}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.triangles = {{1, 4, 2}};  // a sheet at an edge of the tet
  mesh.edges = {{1, 5}};
  mesh.points = {5};
  mesh.tags = {{"base", {0, 1, 2}}, {"tip", {3}}};
  const Mesh fine = divide_tets(mesh);
  CHECK(fine.vertices.size() == 6 + 6 + 2 + 1);
  CHECK(fine.triangles.size() == 4);
  CHECK(fine.edges.size() == 2);
  CHECK(fine.points == mesh.points);
  CHECK(fine.tags.at("base").size() == 6);
  CHECK(std::is_sorted(fine.tags.at("base").begin(), fine.tags.at("base").end()));
  CHECK(fine.tags.at("tip") == std::vector<int>{3});
  CHECK_NOTHROW(validate_mesh(fine, "fine"));
}
