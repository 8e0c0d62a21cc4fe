// The structured block of tets: volumes, conformity and mirror symmetry, and the map to a ball.
#include "geometry/shapes/kuhn.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <map>
#include <set>

#include "geometry/errors.hpp"
#include "geometry/shapes/cube_to_ball.hpp"
#include "geometry/shapes/prism.hpp"

using namespace tack;

namespace {

double volume(const Mesh& mesh, const Tet& t) {
  const auto& x = mesh.vertices;
  return (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).dot(x[t[3]] - x[t[0]]) / 6;
}
double volume(const Mesh& mesh) {
  double sum = 0;
  for (const Tet& t : mesh.tets) sum += volume(mesh, t);
  return sum;
}

// Returns the number of uses of each face, by its sorted corners.
std::map<std::array<int, 3>, int> faces(const Mesh& mesh) {
  std::map<std::array<int, 3>, int> uses;
  for (const Tet& t : mesh.tets)
    for (int k = 0; k < 4; ++k) {
      std::array<int, 3> face = {t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
      std::sort(face.begin(), face.end());
      ++uses[face];
    }
  return uses;
}

const std::vector<std::array<int, 3>> sizes = {{1, 1, 1}, {2, 2, 2}, {2, 4, 6}, {4, 2, 2}};

}  // namespace

TEST_CASE("tets of a Kuhn cube are positive and equal, and fill it", "[shapes]") {
  for (const auto& cells : sizes)
    for (const bool mirrored : {false, true}) {
      if (mirrored && cells[0] % 2) continue;
      const Mesh mesh = kuhn_cube("test", cells, {mirrored, mirrored, mirrored});
      const double number = cells[0] * cells[1] * cells[2];
      CHECK(mesh.tets.size() == static_cast<size_t>(6 * number));
      for (const Tet& t : mesh.tets) CHECK(volume(mesh, t) == Approx(8 / number / 6));
      CHECK(volume(mesh) == Approx(8));
    }
}

TEST_CASE("neighbours of a Kuhn cube conform: a face has two tets inside and one on the boundary", "[shapes]") {
  for (const auto& cells : sizes)
    for (int axes = 0; axes < 8; ++axes) {
      const std::array<bool, 3> mirrored = {(axes & 1) != 0, (axes & 2) != 0, (axes & 4) != 0};
      if (cells[0] == 1 && axes) continue;
      const Mesh mesh = kuhn_cube("test", cells, mirrored);
      int outer = 0;
      for (const auto& [face, uses] : faces(mesh)) {
        CHECK(uses <= 2);
        if (uses == 2) continue;
        ++outer;
        bool on_side = false;
        for (int axis = 0; axis < 3; ++axis)
          for (const double side : {-1.0, 1.0})
            on_side = on_side || std::all_of(face.begin(), face.end(), [&](int v) { return mesh.vertices[v][axis] == side; });
        CHECK(on_side);
      }
      CHECK(outer == 4 * (cells[0] * cells[1] + cells[1] * cells[2] + cells[2] * cells[0]));
    }
}

TEST_CASE("a mirrored Kuhn cube is its own mirror image along each mirrored axis", "[shapes]") {
  const std::array<int, 3> cells = {2, 4, 2};
  const Mesh mesh = kuhn_cube("test", cells, {true, true, true});
  const auto key = [](const Vec3& p) { return std::array{p.x(), p.y(), p.z()}; };
  using Corners = std::set<std::array<double, 3>>;
  std::set<Corners> tets;
  for (const Tet& t : mesh.tets) {
    Corners c;
    for (const int v : t) c.insert(key(mesh.vertices[v]));
    tets.insert(c);
  }
  for (int axis = 0; axis < 3; ++axis)
    for (const Tet& t : mesh.tets) {
      Corners c;
      for (const int v : t) {
        Vec3 p = mesh.vertices[v];
        p[axis] = p[axis] == 0 ? 0 : -p[axis];
        c.insert(key(p));
      }
      CHECK(tets.count(c) == 1);
    }
}

TEST_CASE("a Kuhn cube refuses no cells, odd ones along a mirrored axis, and too many", "[shapes]") {
  CHECK_THROWS_AS(kuhn_cube("test", {0, 1, 1}, {false, false, false}), InputError);
  CHECK_THROWS_AS(kuhn_cube("test", {1, 3, 1}, {false, true, false}), InputError);
  CHECK_THROWS_WITH(kuhn_cube("thing", {1000, 1000, 1000}, {false, false, false}), Catch::Contains("thing"));
}

TEST_CASE("the cube is mapped to the ball shell by shell, with its symmetries", "[shapes]") {
  for (double x = -1; x <= 1; x += 0.25)
    for (double y = -1; y <= 1; y += 0.25)
      for (double z = -1; z <= 1; z += 0.25) {
        const Vec3 p(x, y, z), q = cube_to_ball<3>(p);
        CHECK(q.norm() == Approx(p.cwiseAbs().maxCoeff()));
        CHECK(cube_to_ball<3>(Vec3(-p)) == Vec3(-q));
        CHECK(cube_to_ball<3>(Vec3(y, x, z)) == Vec3(q.y(), q.x(), q.z()));
        const Vec2 flat = cube_to_ball<2>(Vec2(x, y));
        CHECK(flat.norm() == Approx(std::max(std::abs(x), std::abs(y))));
      }
  CHECK(cube_to_ball<3>(Vec3::Zero()) == Vec3::Zero());
  // Equal steps along an edge of the square are equal angles.
  for (const double y : {-0.75, 0.25, 0.5}) {
    const Vec2 q = cube_to_ball<2>(Vec2(1, y));
    CHECK(std::atan2(q.y(), q.x()) == Approx(M_PI / 4 * y));
  }
}

TEST_CASE("a prism has three positive tets of its volume, fewer where corners coincide", "[shapes]") {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}, {1, 0, 2}, {0, 1, 2}};
  for (const auto& [one, other] : {std::pair(std::array{0, 1, 2}, std::array{3, 4, 5}), std::pair(std::array{2, 0, 1}, std::array{5, 3, 4}),
                                   std::pair(std::array{3, 5, 4}, std::array{0, 2, 1})}) {
    mesh.tets.clear();
    add_prism(mesh, one, other);
    CHECK(mesh.tets.size() == 3);
    for (const Tet& t : mesh.tets) CHECK(volume(mesh, t) > 0);
    CHECK(volume(mesh) == Approx(1));
  }
  mesh.tets.clear();
  add_prism(mesh, {0, 1, 2}, {0, 4, 5});
  CHECK(mesh.tets.size() == 2);
  mesh.tets.clear();
  add_prism(mesh, {0, 1, 2}, {0, 1, 5});
  CHECK(mesh.tets.size() == 1);
  CHECK(volume(mesh) == Approx(1 / 3.0));
}

TEST_CASE("prisms that list the corners of a common side in one order conform", "[shapes]") {
  // Two prisms over the triangles (0, 1, 2) and (1, 3, 2).
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  add_prism(mesh, {0, 1, 2}, {4, 5, 6});
  add_prism(mesh, {3, 1, 2}, {7, 5, 6});
  CHECK(volume(mesh) == Approx(1));
  int outer = 0;
  for (const auto& [face, uses] : faces(mesh)) {
    CHECK(uses <= 2);
    outer += uses == 1;
  }
  CHECK(outer == 2 * 2 + 4 * 2);  // top and bottom, four sides
}
