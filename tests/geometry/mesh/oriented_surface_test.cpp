#include "geometry/mesh/oriented_surface.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

// The faces of a tet, outwards; its vertices stand apart in x.
const std::vector<Triangle> tet_faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

VecX unit_tet() {
  VecX x = VecX::Zero(12);
  x(3) = x(7) = x(11) = 1;
  return x;
}

// n x n cells of a square in the plane z, with numbers from `first` on.
std::vector<Triangle> square(int n, int first) {
  std::vector<Triangle> all;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = first + j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      all.push_back({a, b, d});
      all.push_back({a, d, c});
    }
  return all;
}

VecX two_squares(int n, double gap) {
  const int each = (n + 1) * (n + 1);
  VecX x(6 * each);
  for (int k = 0; k < 2 * each; ++k) vertex(x, k) = Vec3((k % each) % (n + 1), (k % each) / (n + 1), k < each ? 0 : gap);
  return x;
}

}  // namespace

TEST_CASE("the volume of a closed surface does not depend on the origin, and its area vectors are the gradient", "[mesh]") {
  const OrientedSurface surface(consistently_oriented(tet_faces));
  CHECK(surface.closed());
  RandomMotions random(1);
  const VecX x = unit_tet() + 0.2 * random.vectors(12);
  const double volume = surface.volume(x, Vec3::Zero());
  CHECK(surface.volume(unit_tet(), Vec3::Zero()) == Approx(1.0 / 6));
  CHECK(surface.volume(x, Vec3(3, -2, 5)) == Approx(volume));
  VecX areas = VecX::Zero(12), by_edges = areas;
  surface.add_areas(x, 1, areas);
  for (const auto& e : surface.edges()) {
    vertex(by_edges, e.a) += surface.edge_area_vector(e, x);
    vertex(by_edges, e.b) += surface.edge_area_vector(e, x);
  }
  const VecX differences = gradient_by_differences([&](const VecX& y) { return surface.volume(y, Vec3(1, 1, 1)); }, x, 1e-3);
  CHECK((areas - differences).norm() < 1e-12);
  CHECK((areas - by_edges).norm() < 1e-15);
  CHECK(total(areas).norm() < 1e-15);
  CHECK(total_moment(x, areas).norm() < 1e-15);
}

TEST_CASE("triangles are consistently oriented, and one-sided surfaces are refused", "[mesh]") {
  std::vector<Triangle> mixed = tet_faces;
  std::swap(mixed[2][0], mixed[2][1]);
  const OrientedSurface surface(consistently_oriented(mixed));
  CHECK(surface.volume(unit_tet(), Vec3::Zero()) == Approx(1.0 / 6));
  // A strip of an odd number of triangles, closed with half a turn.
  const std::vector<Triangle> moebius{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}};
  CHECK_THROWS_AS(consistently_oriented(moebius), InputError);
  CHECK_THROWS_AS(consistently_oriented({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), InputError);
}

TEST_CASE("the slit between two boundaries is closed: a box of two squares", "[mesh]") {
  for (const int n : {1, 3}) {
    std::vector<Triangle> all = square(n, 0);
    for (Triangle t : square(n, (n + 1) * (n + 1))) {
      std::swap(t[0], t[1]);
      all.push_back(t);
    }
    const VecX x = two_squares(n, 0.25);
    const auto loops = boundary_loops(all);
    REQUIRE(loops.size() == 2);
    CHECK(loops[0].size() == static_cast<size_t>(4 * n));
    const auto strip = stitched(loops[0], loops[1], x);
    CHECK(strip.size() == static_cast<size_t>(8 * n));
    all.insert(all.end(), strip.begin(), strip.end());
    const OrientedSurface surface(consistently_oriented(all));
    CHECK(surface.closed());
    CHECK(std::abs(surface.volume(x, Vec3::Zero())) == Approx(0.25 * n * n));
    CHECK(surface.area(x) == Approx(2 * n * n + 4 * n * 0.25));
    CHECK(components_by_edges(all) == std::vector<int>(all.size(), 0));
  }
}
