#include "geometry/exact/intersections.hpp"

#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <limits>

#include "geometry/errors.hpp"
#include "geometry/exact/separating_axis.hpp"
#include "tests/geometry/broad_phase/scenes.hpp"

using namespace tack;
using scenes::Scene;

namespace {

// The triangle (0,0,0) (1,0,0) (0,1,0), lifted onto a tilted plane or not, and the edge pq.
int hits(const Vec3& p, const Vec3& q, bool tilted = false) {
  Mat3 map = Mat3::Identity();  // exact for the coordinates used here: z' = z + x/2 + y/4
  if (tilted) map.row(2) = Vec3(0.5, 0.25, 1.0);
  Scene scene;
  const int a = scene.add_vertex(map * Vec3(0, 0, 0), 0),
            b = scene.add_vertex(map * Vec3(1, 0, 0), 0),
            c = scene.add_vertex(map * Vec3(0, 1, 0), 0);
  scene.mesh.triangles.push_back({a, b, c});
  const int first = scene.add_vertex(map * p, 1);
  scene.add_rod_edge(first, scene.add_vertex(map * q, 1));
  return static_cast<int>(find_intersections(scene.mesh, scene.x(), CollidingObjects(), 10).size());
}

}  // namespace

TEST_CASE("edge against triangle, known cases", "[intersections]") {
  for (const bool tilted : {false, true}) {
    CHECK(hits({0.25, 0.25, -1}, {0.25, 0.25, 1}, tilted) == 1);      // through the middle
    CHECK(hits({0.75, 0.75, -1}, {0.75, 0.75, 1}, tilted) == 0);      // beside it
    CHECK(hits({0.5, 0.5, -1}, {0.5, 0.5, 1}, tilted) == 1);          // through its edge
    CHECK(hits({1, 0, -1}, {1, 0, 1}, tilted) == 1);                  // through its vertex
    CHECK(hits({0, 0, 0}, {-1, -1, 1}, tilted) == 1);                 // end touches a vertex
    CHECK(hits({0.25, 0.25, 0}, {0.25, 0.25, 1}, tilted) == 1);       // end touches the inside
    CHECK(hits({0.25, 0.25, 1e-14}, {0.25, 0.25, 1}, tilted) == 0);   // end just above
    CHECK(hits({0.1, 0.3, 1e-14}, {0.3, 0.1, 1e-14}, tilted) == 0);   // all of it just above
    CHECK(hits({0.25, 0.25, -1e-14}, {0.25, 0.25, 1}, tilted) == 1);  // end just below
    CHECK(hits({0.125, 0.125, 0}, {0.25, 0.25, 0}, tilted) == 1);     // in the plane, inside
    CHECK(hits({-1, 0.25, 0}, {2, 0.25, 0}, tilted) == 1);            // in the plane, across
    CHECK(hits({0.5, 0.75, 0}, {0.75, 0.5, 0}, tilted) == 0);         // in the plane, outside
    CHECK(hits({-1, 0, 0}, {2, 0, 0}, tilted) == 1);                  // along its edge
    CHECK(hits({2, 0, 0}, {3, 0, 0}, tilted) == 0);                   // on the line of its edge
  }
}

TEST_CASE("degenerate triangles and edges are segments and points", "[intersections]") {
  const auto meets = [](const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
    Scene scene;
    const int first = scene.add_vertex(p, 0);
    scene.add_rod_edge(first, scene.add_vertex(q, 0));
    const int corner = scene.add_vertex(a, 1);
    scene.add_vertex(b, 1);
    scene.add_vertex(c, 1);
    scene.mesh.triangles.push_back({corner, corner + 1, corner + 2});
    return !find_intersections(scene.mesh, scene.x(), CollidingObjects(), 1).empty();
  };
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(2, 0, 0), above(0.5, 0, 1), below(0.5, 0, -1), m(0.5, 0, 0);
  CHECK(meets(above, below, a, b, c));        // sliver crossed
  CHECK_FALSE(meets(above, above, a, b, c));  // point beside a sliver
  CHECK(meets(m, m, a, b, c));                // point on a sliver
  CHECK(meets(m, m, a, b, Vec3(0, 1, 0)));    // point on a triangle
  CHECK(meets(above, below, m, m, m));        // triangle that is a point, on the segment
  CHECK_FALSE(meets(above, below, a, a, a));  // and beside it
  CHECK(meets(a, a, a, a, a));
  CHECK_FALSE(meets(a, a, b, b, b));
}

TEST_CASE("a quick proof of disjointness never contradicts the exact answer", "[intersections]") {
  std::mt19937 random(13);
  int proofs = 0;
  for (int k = 0; k < 20000; ++k) {
    Vec3 corner[3];
    for (Vec3& c : corner) c = scenes::random_point(random, 1.0) + Vec3(100, 200, 300);
    // The segment starts on the triangle, up to rounding of its weights, and pokes 1e-12 through
    // it.
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double s = unit(random), t = (1.0 - s) * unit(random);
    const Vec3 u = corner[1] - corner[0], v = corner[2] - corner[0];
    const Vec3 foot = corner[0] + s * u + t * v, normal = u.cross(v).normalized();
    const Vec3 through = foot - 1e-12 * normal;
    const Vec3 tip = foot + normal;
    REQUIRE_FALSE(certainly_disjoint(through, tip, corner[0], corner[1], corner[2]));
    const Vec3 off = foot + 1e-9 * normal;
    proofs += certainly_disjoint(off, tip, corner[0], corner[1], corner[2]);
  }
  REQUIRE(proofs > 19000);
}

TEST_CASE("sheets: apart, crossing, and passing through each other", "[intersections]") {
  const Scene scene = scenes::two_sheets(20, 1e-6);
  VecX x = scene.x();
  REQUIRE(find_intersections(scene.mesh, x, CollidingObjects(), 10).empty());
  for (const double angle : {0.1, 1.0, 2.0}) {  // flat sheets in general position: nearly coplanar
    VecX turned = x;
    const Mat3 rotation = Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (const int v : scene.mesh.vertices) vertex(turned, v) = rotation * Vec3(vertex(x, v));
    REQUIRE(find_intersections(scene.mesh, turned, CollidingObjects(), 10).empty());
  }
  const int v = 210;  // in the middle of the lower sheet
  x[3 * v + 2] = 2e-6;
  const auto hits = find_intersections(scene.mesh, x, CollidingObjects(), 1000);
  REQUIRE(hits.size() > 3);
  for (const auto& [edge, triangle] : hits) {
    const Edge& e = scene.mesh.edges[edge];
    const Triangle& t = scene.mesh.triangles[triangle];
    REQUIRE((e[0] == v || e[1] == v || t[0] == v || t[1] == v || t[2] == v));
  }
  CollidingObjects only_self;
  only_self.set(0, 1, false);
  REQUIRE(find_intersections(scene.mesh, x, only_self, 1000).empty());
}

TEST_CASE("a sheet that crosses itself", "[intersections]") {
  REQUIRE(find_intersections(scenes::folded_sheet(20, 0.02).mesh,
                             scenes::folded_sheet(20, 0.02).x(), CollidingObjects(), 1)
              .empty());
  Scene scene;  // a tube that closes beyond a full turn, with a pitch: it passes through itself
  scene.add_sheet(30, 0, [](double u, double v) {
    const double angle = 2.4 * M_PI * u, radius = 1.0 + 0.2 * std::sin(1.25 * angle);
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), v);
  });
  REQUIRE(!find_intersections(scene.mesh, scene.x(), CollidingObjects(), 1).empty());
}

TEST_CASE("limits, flags and threads of the intersection check", "[intersections]") {
  Scene scene = scenes::triangle_soup(300);
  const VecX x = scene.x();
  std::vector<std::vector<EdgeTriangleHit>> runs;
  for (const std::size_t threads : {1, 2}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    runs.push_back(find_intersections(scene.mesh, x, CollidingObjects(), 1 << 20));
  }
  REQUIRE(runs[0].size() > 20);
  REQUIRE(runs[0] == runs[1]);
  const auto few = find_intersections(scene.mesh, x, CollidingObjects(), 5);
  REQUIRE(few == std::vector<EdgeTriangleHit>(runs[0].begin(), runs[0].begin() + 5));

  for (const int object : {0, 1, 2}) scene.freeze(object);
  REQUIRE(find_intersections(scene.mesh, x, CollidingObjects(), 1 << 20).empty());
  REQUIRE(find_intersections(scene.mesh, x, CollidingObjects(), 1 << 20, false) == runs[0]);

  VecX broken = x;
  broken[5] = std::numeric_limits<double>::infinity();
  REQUIRE_THROWS_AS(find_intersections(scene.mesh, broken, CollidingObjects(), 1), SimulationError);
  REQUIRE_THROWS_AS(find_intersections(scene.mesh, VecX::Zero(3), CollidingObjects(), 1),
                    InputError);
}
