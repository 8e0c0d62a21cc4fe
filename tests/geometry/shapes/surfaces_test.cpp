#include "geometry/shapes/surfaces.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>

#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/surface.hpp"
#include "geometry/mesh/validate.hpp"
#include "tests/support/closed_surface.hpp"

using namespace tack;
using std::numbers::pi;

namespace {

Vec3 normal(const Mesh& mesh, const Triangle& t) {
  const auto& x = mesh.vertices;
  return (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).normalized();
}

}  // namespace

TEST_CASE("a grid lies in y = 0, faces up and has its nodes in order", "[shapes]") {
  for (auto diagonals : {Diagonals::uniform, Diagonals::alternating}) {
    const Mesh mesh = grid(Vec2(2, 3), {4, 5}, diagonals);
    CHECK_NOTHROW(validate_mesh(mesh, "grid"));
    CHECK(mesh.triangles.size() == 2 * 4 * 5);
    CHECK(total_area(mesh) == Approx(6));
    CHECK(mesh.vertices[3 + 5 * 2].isApprox(Vec3(-1 + 0.5 * 3, 0, -1.5 + 0.6 * 2)));
    for (const Triangle& t : mesh.triangles) CHECK(normal(mesh, t) == Vec3(0, 1, 0));
    CHECK(euler_characteristic(extract_surface(mesh)) == 1);
  }
}

TEST_CASE("diagonals have one direction or alternate", "[shapes]") {
  const auto has_edge = [](const Mesh& mesh, const Edge& edge) {
    const auto edges = extract_surface(mesh).edges;
    return std::find(edges.begin(), edges.end(), edge) != edges.end();
  };
  // Nodes 0 1 2 in the first row, 3 4 5 in the second.
  const Mesh uniform = grid(Vec2(1, 1), {2, 1}, Diagonals::uniform);
  CHECK(has_edge(uniform, {0, 4}));
  CHECK(has_edge(uniform, {1, 5}));
  const Mesh alternating = grid(Vec2(1, 1), {2, 1}, Diagonals::alternating);
  CHECK(has_edge(alternating, {0, 4}));
  CHECK(has_edge(alternating, {2, 4}));
}

TEST_CASE("a box surface is closed, outward and of the right size", "[shapes]") {
  const Mesh small = box_surface(Vec3(1, 1, 1));
  CHECK(small.vertices.size() == 8);
  CHECK(small.triangles.size() == 12);
  for (const auto& cells : {std::array{1, 1, 1}, std::array{3, 4, 7}}) {
    const Mesh box = box_surface(Vec3(0.3, 0.7, 1.1), cells);
    CHECK_NOTHROW(validate_mesh(box, "box"));
    CHECK(is_closed_manifold(box.triangles));
    CHECK(euler_characteristic(extract_surface(box)) == 2);
    CHECK(enclosed_volume(box, box.triangles) == Approx(0.3 * 0.7 * 1.1));
    CHECK(total_area(box) == Approx(2 * (0.21 + 0.33 + 0.77)));
    CHECK(bounding_box(box).max() == Vec3(0.15, 0.35, 0.55));
  }
  CHECK(normal(small, small.triangles[0]) == Vec3(-1, 0, 0));
  CHECK(normal(small, small.triangles[2]) == Vec3(1, 0, 0));
  CHECK(normal(small, small.triangles[11]) == Vec3(0, 0, 1));
}

TEST_CASE("a geodesic sphere converges to its area and volume", "[shapes]") {
  double previous = 1;
  for (int cells : {1, 2, 3, 6, 12}) {
    const Mesh ball = sphere_surface(0.5, cells);
    CHECK_NOTHROW(validate_mesh(ball, "sphere"));
    CHECK(ball.vertices.size() == 10u * cells * cells + 2);
    CHECK(ball.triangles.size() == 20u * cells * cells);
    CHECK(is_closed_manifold(ball.triangles));
    CHECK(euler_characteristic(extract_surface(ball)) == 2);
    const double error = 1 - enclosed_volume(ball, ball.triangles) / (4 * pi / 3 * 0.125);
    CHECK(error > 0);
    CHECK(error < previous);
    previous = error;
    if (cells == 12) CHECK(total_area(ball) == Approx(pi).epsilon(0.01));
  }
  CHECK(previous < 0.01);
}

TEST_CASE("surfaces refuse sizes and cells that make no mesh", "[shapes]") {
  CHECK_THROWS_AS(grid(Vec2(1, -1), {1, 1}), InputError);
  CHECK_THROWS_AS(grid(Vec2(1, 1), {0, 1}), InputError);
  CHECK_THROWS_AS(grid(Vec2(1, 1), {100000, 100000}), InputError);
  CHECK_THROWS_AS(box_surface(Vec3(1, 1, 0)), InputError);
  CHECK_THROWS_AS(box_surface(Vec3(1, 1, 1), {1, 1, -1}), InputError);
  CHECK_THROWS_AS(sphere_surface(0, 1), InputError);
  CHECK_THROWS_AS(sphere_surface(1, 0), InputError);
}

TEST_CASE("a grid with jitter has straight borders and the same area, and is determined by the seed", "[shapes]") {
  const Mesh regular = grid(Vec2(2, 3), {6, 9}, Diagonals::uniform);
  const Mesh mesh = grid(Vec2(2, 3), {6, 9}, Diagonals::uniform, 0.24), again = grid(Vec2(2, 3), {6, 9}, Diagonals::uniform, 0.24);
  const Mesh other = grid(Vec2(2, 3), {6, 9}, Diagonals::uniform, 0.24, 2);
  CHECK(mesh.triangles == regular.triangles);
  CHECK(total_area(mesh) == Approx(6));
  for (const Triangle& t : mesh.triangles) CHECK(normal(mesh, t).y() == Approx(1));
  int moved = 0;
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 x = regular.vertices[v], by = mesh.vertices[v] - x;
    CHECK(mesh.vertices[v] == again.vertices[v]);
    const bool border = std::abs(x.x()) > 1 - 1e-9 || std::abs(x.z()) > 1.5 - 1e-9;
    if (border) CHECK(by == Vec3::Zero());
    else moved += by.norm() > 0 && other.vertices[v] != mesh.vertices[v];
    CHECK(by.y() == 0);
    CHECK(by.lpNorm<Eigen::Infinity>() <= 0.24 / 3 + 1e-12);
  }
  CHECK(moved == 5 * 8);
  CHECK_THROWS_AS(grid(Vec2(1, 1), {2, 2}, Diagonals::uniform, 0.25), InputError);
}
