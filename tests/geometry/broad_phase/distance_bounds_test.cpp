#include "geometry/broad_phase/broad_phase.hpp"

#include <catch2/catch.hpp>

#include "geometry/broad_phase/displacement_bounds.hpp"
#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/point_edge.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "tests/geometry/broad_phase/scenes.hpp"

using namespace tack;
using namespace tack::scenes;

namespace {

constexpr double range = 0.0213, skin = 0.0107;

struct Count {
  int all = 0, apart = 0;  // pairs, and pairs whose bounds exclude contact
};

// Every distance is at least its bound, and its reference distance less both displacement bounds.
Count check_bounds(const CollisionMesh& mesh, const Candidates& c, const VecX& x) {
  Count count;
  const auto at = [&](int v) { return Vec3(vertex(x, v)); };
  const DisplacementBounds displacements(mesh, [&](int v) { return (at(v) - vertex(c.reference, v)).norm(); });
  const auto of_vertex = [&](int v) { return displacements.vertex(v); };
  const auto of_edge = [&](int e) { return displacements.edge(e); };
  const auto of_triangle = [&](int t) { return displacements.triangle(t); };
  const auto check = [&](const auto& pairs, auto member, const auto& first, const auto& second, const auto& squared) {
    const std::vector<double>&distance_bounds = c.distance_bounds.*member, &distances = c.reference_distances.*member;
    REQUIRE(pairs.size() == distance_bounds.size());
    REQUIRE(pairs.size() == distances.size());
    for (size_t i = 0; i < pairs.size(); ++i) {
      REQUIRE(distance_bounds[i] >= 0);
      REQUIRE(distances[i] >= distance_bounds[i]);
      const double distance = std::sqrt(squared(pairs[i][0], pairs[i][1]));
      REQUIRE(distance >= distance_bounds[i]);
      REQUIRE(distance >= distances[i] - first(pairs[i][0]) - second(pairs[i][1]));
      ++count.all;
      count.apart += distance_bounds[i] >= range;
    }
  };
  check(c.point_triangle, &CandidateLengths::point_triangle, of_vertex, of_triangle, [&](int p, int t) {
    const Triangle& f = mesh.triangles[t];
    return point_triangle_distance(at(p), at(f[0]), at(f[1]), at(f[2]));
  });
  check(c.edge_edge, &CandidateLengths::edge_edge, of_edge, of_edge, [&](int i, int j) {
    const Edge &a = mesh.edges[i], &b = mesh.edges[j];
    return edge_edge_distance(at(a[0]), at(a[1]), at(b[0]), at(b[1]));
  });
  check(c.point_edge, &CandidateLengths::point_edge, of_vertex, of_edge, [&](int p, int e) {
    return point_edge_distance(at(p), at(mesh.edges[e][0]), at(mesh.edges[e][1]));
  });
  check(c.point_point, &CandidateLengths::point_point, of_vertex, of_vertex, [&](int a, int b) { return (at(a) - at(b)).squaredNorm(); });
  return count;
}

std::vector<Scene> all_scenes() {
  return {triangle_soup(150), two_sheets(12, 0.01), folded_sheet(20, 0.02), mixed(12, 60)};
}

// Returns random positions inside the fat AABBs of the displacement x + s p, often at their corners.
VecX inside_boxes(std::mt19937& random, const VecX& x, const VecX& p, double margin) {
  const auto sign = [](double u) { return u > 0 ? 1.0 : -1.0; };
  const VecX corner = random_motion(random, x.size(), 1.0).unaryExpr(sign);
  return x + (0.5 * (corner.array() + 1)).matrix().cwiseProduct(p) + (margin * corner.cwiseProduct(p.unaryExpr(sign)));
}

}  // namespace

TEST_CASE("distance bounds hold for all positions inside the fat AABBs", "[broad_phase]") {
  std::mt19937 random(13);
  for (const Scene& scene : all_scenes())
    for (const double motion : {1e-9, 0.02})
      for (const double offset : {0.0, 1e5}) {
        const VecX x = scene.x().array() + offset, p = random_motion(random, x.size(), motion);
        BroadPhase broad_phase(scene.mesh, CollidingObjects());
        broad_phase.update(x, p, range, skin);
        for (int trial = 0; trial < 5; ++trial) {
          const VecX y = inside_boxes(random, x, p, 0.4999 * skin);
          REQUIRE(broad_phase.covers(y));
          const Count count = check_bounds(scene.mesh, broad_phase.candidates(), y);
          if (motion < skin) CHECK(count.apart > count.all / 10);
        }
      }
}

TEST_CASE("distance bounds hold after a search of some objects alone", "[broad_phase]") {
  std::mt19937 random(19);
  for (const Scene& scene : {triangle_soup(150), mixed(12, 60)}) {
    VecX x = scene.x();
    const auto of_first = [&](VecX way) {
      for (Eigen::Index v = 0; v < x.size() / 3; ++v)
        if (scene.mesh.vertex_object[v] != 0) way.segment<3>(3 * v).setZero();
      return way;
    };
    BroadPhase broad_phase(scene.mesh, CollidingObjects());
    broad_phase.update(x, VecX(), range, skin);
    int apart = 0;
    for (int step = 0; step < 12; ++step) {
      const VecX still = 0.4999 * skin * random_motion(random, x.size(), 1.0);
      if (step % 4 == 3)  // vertices come to rest far from the reference, which moves there
        for (int i = 0; i < 40; ++i) broad_phase.update(x + 0.02 * still, VecX(), range, skin);
      const VecX p = of_first(random_motion(random, x.size(), step % 2 == 0 ? 0.05 : 0.2));
      broad_phase.update(x, p, range, skin);
      x += p;
      REQUIRE(broad_phase.covers(x));
      apart += check_bounds(scene.mesh, broad_phase.candidates(), x).apart;
      check_bounds(scene.mesh, broad_phase.candidates(), x - 0.5 * p);
      check_bounds(scene.mesh, broad_phase.candidates(), inside_boxes(random, x - p, p, 0.4999 * skin));
    }
    CHECK(apart > 0);
    CHECK(broad_phase.builds() >= 12);
  }
}

TEST_CASE("distance bounds grow while vertices hardly move, and hold when they move again", "[broad_phase]") {
  std::mt19937 random(17);
  for (const Scene& scene : all_scenes()) {
    const VecX x = scene.x();
    BroadPhase broad_phase(scene.mesh, CollidingObjects());
    broad_phase.update(x, VecX(), range, skin);
    const int loose = check_bounds(scene.mesh, broad_phase.candidates(), x).apart;
    int tight = loose, renewed = 0;
    for (int i = 0; i < 300; ++i) {
      const VecX y = x + random_motion(random, x.size(), i % 100 < 60 ? 0.02 * skin : 0.49 * skin);
      renewed += broad_phase.update(y, VecX(), range, skin);
      tight = std::max(tight, check_bounds(scene.mesh, broad_phase.candidates(), y).apart);
    }
    CHECK(tight > loose);
    CHECK(renewed >= 2);
    CHECK(renewed < 10);
    CHECK(broad_phase.builds() == 1);
  }
}
