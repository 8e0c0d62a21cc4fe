// Formulas of one line each: the matrix of a cross product, coordinates in a tet, joined lists.
#include <catch2/catch.hpp>
#include <Eigen/Geometry>
#include <random>

#include "geometry/concatenate.hpp"
#include "geometry/cross_matrix.hpp"
#include "geometry/mesh/object_elements.hpp"
#include "geometry/mesh/sorted.hpp"
#include "geometry/tet_coordinates.hpp"

using namespace tack;

namespace {

class Points {
 public:
  Vec3 operator()() { return {number(), number(), number()}; }
  double number() { return std::uniform_real_distribution<double>(-1, 1)(generator_); }

 private:
  std::mt19937 generator_{1};
};

}  // namespace

TEST_CASE("the cross matrix is antisymmetric and yields the cross product", "[geometry]") {
  Points random;
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 w = random(), v = random();
    CHECK((cross_matrix(w) * v - w.cross(v)).norm() < 1e-15);
    CHECK(cross_matrix(w).transpose() == -cross_matrix(w));
  }
}

TEST_CASE("tet coordinates are a partition of unity that reproduces the point, and unit vectors at the corners", "[geometry]") {
  Points random;
  for (int trial = 0; trial < 50; ++trial) {
    const std::array<Vec3, 4> c = {random(), random(), random(), random()};
    if (std::abs(edges_of(c).determinant()) < 0.05) continue;
    const Vec3 p = random();
    const auto b = tet_coordinates(c, p);
    CHECK(b[0] + b[1] + b[2] + b[3] == Approx(1));
    CHECK((b[0] * c[0] + b[1] * c[1] + b[2] * c[2] + b[3] * c[3] - p).norm() < 1e-12);
    for (int k = 0; k < 4; ++k) {
      const auto at = tet_coordinates(c, c[k]);
      for (int i = 0; i < 4; ++i) CHECK(at[i] == Approx(i == k).margin(1e-12));
      CHECK(tet_coordinates(c, (c[0] + c[1] + c[2] + c[3]) / 4)[k] == Approx(0.25));
    }
  }
}

TEST_CASE("the determinant of the edges of a tet is six volumes, negative if it is inverted", "[geometry]") {
  const std::array<Vec3, 4> c = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 3, 0), Vec3(0, 0, 4)};
  CHECK(edges_of(c).determinant() == Approx(24));
  CHECK(edges_of(std::array{c[1], c[0], c[2], c[3]}).determinant() == Approx(-24));
  VecX x(12);
  x << c[0], c[1], c[2], c[3];
  CHECK(edges_of(Tet{0, 1, 2, 3}, x) == edges_of(c));
}

TEST_CASE("concatenation keeps the order, for any number of lists", "[geometry]") {
  std::mt19937 random(2);
  for (const int lists : {0, 1, 3, 500}) {
    std::vector<std::vector<int>> parts(lists);
    std::vector<int> expected, joined = {7, 7};
    for (auto& p : parts) {
      p.resize(random() % 5);
      for (int& i : p) i = static_cast<int>(random() % 100);
      expected.insert(expected.end(), p.begin(), p.end());
    }
    concatenate(parts, joined);
    CHECK(joined == expected);
  }
}

TEST_CASE("elements of an object are a contiguous range", "[geometry]") {
  CollisionMesh mesh;
  mesh.vertex_object = {0, 0, 1, 1, 3, 3};  // object 2 has none
  const std::vector<Edge> edges = {{0, 1}, {1, 0}, {2, 3}, {4, 5}, {5, 4}};
  CHECK(first_of_objects(mesh, edges) == std::vector{0, 2, 3, 3, 5});
  CHECK(first_of_objects(mesh, std::vector<Edge>()) == std::vector{0, 0, 0, 0, 0});
}

TEST_CASE("sorted elements and lists ascend, and lists have unique values", "[geometry]") {
  CHECK(sorted(Triangle{5, 2, 9}) == Triangle{2, 5, 9});
  CHECK(sorted(sorted(Triangle{9, 5, 2})) == sorted(Triangle{2, 9, 5}));
  std::vector<int> values = {3, 1, 3, 2, 1, 1};
  sort_unique(values);
  CHECK(values == std::vector{1, 2, 3});
}
