#include "geometry/shapes/lines.hpp"

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "geometry/mesh/validate.hpp"

using namespace tack;

TEST_CASE("a segment is a chain of edges along x", "[shapes]") {
  const Mesh rod = segment(2, 4);
  CHECK_NOTHROW(validate_mesh(rod, "rod"));
  CHECK(rod.vertices.size() == 5);
  CHECK(rod.vertices.front() == Vec3(-1, 0, 0));
  CHECK(rod.vertices.back() == Vec3(1, 0, 0));
  CHECK(rod.edges == std::vector<Edge>{{0, 1}, {1, 2}, {2, 3}, {3, 4}});
  CHECK_THROWS_AS(segment(0, 4), InputError);
  CHECK_THROWS_AS(segment(1, 0), InputError);
}

TEST_CASE("ring: a closed polygon") {
  const Mesh mesh = ring(2, 6);
  REQUIRE(mesh.vertices.size() == 6);
  REQUIRE(mesh.edges.size() == 6);
  CHECK(mesh.edges.back() == Edge{5, 0});
  for (const Edge& e : mesh.edges) CHECK((mesh.vertices[e[1]] - mesh.vertices[e[0]]).norm() == Approx(2));
  // Right-handed about y.
  CHECK(mesh.vertices[0].cross(mesh.vertices[1]).y() > 0);
  CHECK_THROWS_AS(ring(2, 2), InputError);
  CHECK_THROWS_AS(ring(0, 6), InputError);
}

TEST_CASE("helix: radius, pitch and hand") {
  const Mesh mesh = helix(2, 3, 1.5, 12);
  REQUIRE(mesh.vertices.size() == 13);
  REQUIRE(mesh.edges.size() == 12);
  for (const Vec3& v : mesh.vertices) CHECK(std::hypot(v.x(), v.z()) == Approx(2));
  CHECK(mesh.vertices[0].y() == Approx(-2.25));
  CHECK((mesh.vertices[8] - mesh.vertices[0] - Vec3(0, 3, 0)).norm() < 1e-14);
  CHECK(mesh.vertices[0].cross(mesh.vertices[1]).y() > 0);
  CHECK_THROWS_AS(helix(2, 0, 1, 4), InputError);
  CHECK_THROWS_AS(helix(2, 1, 0, 4), InputError);
}

TEST_CASE("a point grid numbers its particles x first", "[shapes]") {
  const Mesh points = point_grid(Vec3(2, 0, 6), {3, 1, 4});
  CHECK_NOTHROW(validate_mesh(points, "points"));
  CHECK(points.points.size() == 12);
  CHECK(points.vertices[0] == Vec3(-1, 0, -3));
  CHECK(points.vertices[2 + 3 * 1] == Vec3(1, 0, -1));
  CHECK(points.vertices[11] == Vec3(1, 0, 3));
  CHECK_THROWS_AS(point_grid(Vec3(1, 0, 1), {2, 2, 2}), InputError);
  CHECK_THROWS_AS(point_grid(Vec3(1, 1, 1), {0, 2, 2}), InputError);
}

namespace {

double total_length(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b] : mesh.edges) sum += (mesh.vertices[a] - mesh.vertices[b]).norm();
  return sum;
}

}  // namespace

TEST_CASE("a net has threads along both sides, knots and a border", "[shapes]") {
  const Mesh threads = net(Vec2(3, 2), {3, 2}, 4);
  CHECK_NOTHROW(validate_mesh(threads, "net"));
  CHECK(total_length(threads) == Approx(3 * 3 + 4 * 2));
  CHECK(threads.edges.size() == 4 * (3 * 3 + 4 * 2));
  CHECK(threads.vertices.size() == 12 + 3 * (3 * 3 + 4 * 2));
  CHECK(threads.tags.at("knots").size() == 12);
  CHECK(threads.tags.at("border").size() == 4 * 10);
  CHECK_THROWS_AS(net(Vec2(1, 0), {1, 1}, 1), InputError);
  CHECK_THROWS_AS(net(Vec2(1, 1), {1, 1}, 0), InputError);
}

TEST_CASE("a web has spokes of its radius and a spiral that is one chain", "[shapes]") {
  const Mesh threads = web(1, 0.2, 8, 3, 0.05);
  CHECK_NOTHROW(validate_mesh(threads, "web"));
  CHECK(threads.tags.at("ends").size() == 8);
  for (const int v : threads.tags.at("ends")) CHECK(threads.vertices[v].norm() == Approx(1));
  for (const auto& [a, b] : threads.edges) CHECK((threads.vertices[a] - threads.vertices[b]).norm() <= 0.05 * (1 + 1e-9));
  double spiral = 0;
  const auto radius = [](int k) { return 0.2 + 0.8 / 3.5 * k / 8; };
  for (int k = 0; k < 24; ++k)
    spiral += std::sqrt(std::pow(radius(k), 2) + std::pow(radius(k + 1), 2) -
                        2 * radius(k) * radius(k + 1) * std::cos(M_PI / 4));
  CHECK(total_length(threads) == Approx(8 + spiral));
  CHECK_THROWS_AS(web(1, 1, 8, 3, 0.05), InputError);
  CHECK_THROWS_AS(web(1, 0.2, 2, 3, 0.05), InputError);
}
