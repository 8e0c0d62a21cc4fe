#include "geometry/mesh/overlaps.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "geometry/errors.hpp"
#include "geometry/mesh/validate.hpp"
#include "geometry/shapes/solids.hpp"

using namespace tack;
using Pairs = std::vector<std::array<int, 2>>;

namespace {

Mesh unit_tet(const Vec3& at = Vec3::Zero(), double size = 1) {
  Mesh mesh;
  for (const Vec3& v : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) mesh.vertices.push_back(at + size * v);
  mesh.tets = {{0, 1, 2, 3}};
  return mesh;
}

Mesh two(const Mesh& second) {
  Mesh mesh = unit_tet();
  append(mesh, second);
  return mesh;
}

}  // namespace

TEST_CASE("meshes whose tets only touch have no overlaps", "[mesh]") {
  CHECK(overlapping_tets(box_tets({1, 2, 3}, {3, 4, 2})).empty());
  CHECK(overlapping_tets(sphere(0.01, 8)).empty());
  CHECK(overlapping_tets(cylinder(1, 2, 6, 4)).empty());
  Mesh turned = box_tets({1, 1, 1}, {3, 3, 3});
  rotate(turned, {1, 2, 3}, 0.7);
  translate(turned, {1e6, -1e6, 1e6});  // round-off of 1e-10 m
  CHECK(overlapping_tets(turned).empty());
  CHECK(overlapping_tets(two(unit_tet({1, 0, 0}))).empty());        // touch in a point
  CHECK(overlapping_tets(two(unit_tet({0, 0, -1}))).empty());
  CHECK(overlapping_tets(two(unit_tet({0.5, 0.5, 0}))).empty());    // touch in an edge's middle
}

TEST_CASE("overlapping tets are found for every kind of overlap", "[mesh]") {
  Mesh doubled = box_tets({1, 1, 1}, {2, 2, 2});
  const int count = static_cast<int>(doubled.tets.size());
  doubled.tets.push_back({doubled.tets[7][1], doubled.tets[7][2], doubled.tets[7][0], doubled.tets[7][3]});
  CHECK(overlapping_tets(doubled) == Pairs{{7, count}});
  CHECK_THROWS_WITH(validate_mesh(doubled, "part.msh"), Catch::Contains("part.msh: tet 7 (") && Catch::Contains("are the same"));

  CHECK(overlapping_tets(two(unit_tet({0, 0, 0}))) == Pairs{{0, 1}});          // vertices not shared
  CHECK(overlapping_tets(two(unit_tet({0.1, 0.1, 0.1}, 0.1))) == Pairs{{0, 1}});  // wholly inside
  CHECK(overlapping_tets(two(unit_tet({0.3, 0.3, 0.3}))) == Pairs{{0, 1}});
  CHECK(overlapping_tets(two(unit_tet({1e-5, 0, 0}))) == Pairs{{0, 1}});
  Mesh face = unit_tet();  // a second tet on the same side of a face
  face.vertices.emplace_back(0.2, 0.2, 0.5);
  face.tets.push_back({0, 1, 2, 4});
  CHECK(overlapping_tets(face) == Pairs{{0, 1}});
  CHECK_THROWS_WITH(validate_mesh(face, "part.msh"), Catch::Contains("and tet 1 (vertices 0 1 2 4) overlap, near (0.3, 0.3, 0.125) m (1 such pairs)"));
  Mesh corner = unit_tet();  // inside, and only a vertex in common
  for (const Vec3& v : {Vec3(0.2, 0.01, 0.01), Vec3(0.01, 0.2, 0.01), Vec3(0.01, 0.01, 0.2)}) corner.vertices.push_back(v);
  corner.tets.push_back({0, 4, 5, 6});
  CHECK(overlapping_tets(corner) == Pairs{{0, 1}});
}

TEST_CASE("overlaps agree with points drawn at random", "[mesh]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 1);
  const auto inside = [](const Mesh& mesh, int t, const Vec3& p) {
    const auto& [a, b, c, d] = mesh.tets[t];
    const auto& x = mesh.vertices;
    Mat3 edges;
    edges << x[b] - x[a], x[c] - x[a], x[d] - x[a];
    const Vec3 w = edges.inverse() * (p - x[a]);
    return w.minCoeff() > 0 && w.sum() < 1;
  };
  int overlapping = 0, sampled = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) mesh.vertices.emplace_back(place(random), place(random), place(random) + (i < 4 ? 0 : 0.4));
    mesh.tets = {{0, 1, 2, 3}, {4, 5, 6, 7}};
    const bool found = !overlapping_tets(mesh).empty();
    bool common = false;
    for (int i = 0; i < 2000 && !common; ++i) {
      const Vec3 p(place(random), place(random), 0.4 + 0.6 * place(random));
      common = inside(mesh, 0, p) && inside(mesh, 1, p);
    }
    overlapping += found;
    sampled += common;
    if (common) CHECK(found);
  }
  CHECK(sampled > 30);
  CHECK(overlapping < 300);
  CHECK(overlapping >= sampled);
}
