// Closed surfaces within each other, the thickness of a surface, and slivers that are flipped.
#include "geometry/mesh/nesting.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/mesh/flip_slivers.hpp"
#include "geometry/mesh/mesh.hpp"
#include "geometry/mesh/thickness.hpp"

using namespace tack;

namespace {

struct Surface {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  std::vector<int> part;

  // Adds a box around a centre as a separate component.
  void box(const Vec3& centre, const Vec3& half, bool inwards) {
    const int first = static_cast<int>(vertices.size()), number = part.empty() ? 0 : part.back() + 1;
    for (int i = 0; i < 8; ++i) vertices.push_back(centre + half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
    for (const auto& [a, b, c, d] : {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
      for (Triangle t : {Triangle{first + a, first + b, first + c}, Triangle{first + a, first + c, first + d}}) {
        if (inwards) std::swap(t[1], t[2]);
        triangles.push_back(t);
        part.push_back(number);
      }
  }
  std::vector<int> windings() const { return enclosing_windings(triangles, part, [this](int v) { return vertices[v]; }); }
};

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  return sum;
}

}  // namespace

TEST_CASE("winding numbers of nested shells count enclosing shells by orientation", "[mesh]") {
  Surface s;
  CHECK(s.windings().empty());
  s.box({0, 0, 0}, Vec3::Constant(4), false);
  CHECK(s.windings() == std::vector{0});
  s.box({0.1, 0.2, 0}, Vec3::Constant(3), true);      // a cavity
  s.box({0, 0, 0.3}, Vec3::Constant(2), false);       // floats in it
  s.box({9, 0, 0}, Vec3::Constant(1), false);         // beside all
  s.box({0.2, 0.1, 0.4}, Vec3::Constant(0.5), true);  // a cavity inside the floating body
  CHECK(s.windings() == std::vector{0, 1, 0, 0, 1});
}

TEST_CASE("winding numbers change sign if all surfaces are reversed, and do not depend on the order of triangles", "[mesh]") {
  for (const bool reversed : {false, true}) {
    Surface s;
    s.box({0, 0, 0}, Vec3::Constant(4), reversed);
    s.box({0.5, 0.1, 0.2}, Vec3::Constant(1), reversed);
    std::reverse(s.triangles.begin(), s.triangles.end());
    std::reverse(s.part.begin(), s.part.end());
    CHECK(s.windings() == std::vector{0, reversed ? -1 : 1});
  }
}

TEST_CASE("thickness 2 V / A is that of a plate, and half of that of a bar", "[mesh]") {
  const auto thickness = [](const Vec3& half, const Vec3& centre) {
    Surface s;
    s.box(centre, half, false);
    Thickness t;
    for (const Triangle& v : s.triangles) t.add({s.vertices[v[0]], s.vertices[v[1]], s.vertices[v[2]]});
    CHECK(t.area() == Approx(8 * (half.x() * half.y() + half.y() * half.z() + half.z() * half.x())));
    return t.thickness();
  };
  CHECK(thickness({500, 0.5, 500}, {0, 0, 0}) == Approx(1).epsilon(3e-3));
  CHECK(thickness({500, 0.5, 0.5}, {0, 0, 0}) == Approx(0.5).epsilon(3e-3));
  CHECK(thickness({1, 1, 1}, {0, 0, 0}) == Approx(2 / 3.0));
  CHECK(thickness({1e-3, 1e-3, 1e-3}, {1e6, -2e6, 3e6}) == Approx(2e-3 / 3).epsilon(1e-5));  // far from the origin
  CHECK(Thickness().thickness() == 0);
}

TEST_CASE("a sliver on a closed surface is flipped; flat faces keep the volume", "[mesh]") {
  // A cube whose top is cut by a vertex a hair off the diagonal.
  Surface s;
  s.box({0, 0, 0}, Vec3::Ones(), false);
  Mesh mesh;
  mesh.vertices = s.vertices;
  mesh.triangles = s.triangles;
  std::erase_if(mesh.triangles, [](const Triangle& t) { return std::set<int>(t.begin(), t.end()) == std::set<int>{4, 5, 7}; });
  const int middle = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back({1e-4, -1e-4, 1});
  for (const Triangle& t : {Triangle{4, 5, middle}, Triangle{5, 7, middle}, Triangle{7, 4, middle}}) mesh.triangles.push_back(t);
  const auto vertices = mesh.vertices;
  CHECK(volume(mesh) == Approx(8));
  CHECK(flip_slivers(mesh, 0.01) == 1);
  CHECK(volume(mesh) == Approx(8));
  CHECK(mesh.vertices == vertices);
  CHECK(mesh.triangles.size() == 14);
  // Each directed edge has its opposite: the surface is closed still.
  std::set<std::pair<int, int>> edges;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) CHECK(edges.insert({t[k], t[(k + 1) % 3]}).second);
  for (const auto& [a, b] : edges) CHECK(edges.count({b, a}) == 1);
  CHECK(flip_slivers(mesh, 0.01) == 0);
}

TEST_CASE("triangles that are high enough are not flipped", "[mesh]") {
  Surface s;
  s.box({0, 0, 0}, Vec3::Ones(), false);
  Mesh mesh;
  mesh.vertices = s.vertices;
  mesh.triangles = s.triangles;
  CHECK(flip_slivers(mesh, 1) == 0);
  CHECK(mesh.triangles == s.triangles);
}
