#include "geometry/broad_phase/broad_phase.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "geometry/errors.hpp"
#include "tests/geometry/broad_phase/brute_force.hpp"
#include "tests/geometry/broad_phase/scenes.hpp"

using namespace tack;
using namespace tack::scenes;

namespace {

void require_equal(const Candidates& found, const Candidates& expected) {
  REQUIRE(found.point_triangle == expected.point_triangle);
  REQUIRE(found.edge_edge == expected.edge_edge);
  REQUIRE(found.point_edge == expected.point_edge);
  REQUIRE(found.point_point == expected.point_point);
}

std::vector<Scene> all_scenes() {
  return {triangle_soup(150), two_sheets(12, 0.01), folded_sheet(20, 0.02), mixed(12, 60)};
}

constexpr double kRange = 0.0213,
                 kSkin = 0.0107;  // no multiples of the grids: no ties in the tests

}  // namespace

TEST_CASE("candidates are those of a test of all pairs", "[broad_phase]") {
  std::mt19937 random(3);
  for (const Scene& scene : all_scenes())
    for (const double motion : {0.0, 0.03}) {
      const VecX x = scene.x();
      const VecX p = motion > 0.0 ? random_motion(random, x.size(), motion) : VecX();
      BroadPhase broad_phase(scene.mesh, CollidingObjects());
      REQUIRE(broad_phase.update(x, p, kRange, kSkin));
      const Candidates expected =
          BruteForce(scene.mesh, CollidingObjects(), x, p, kRange, kSkin).find();
      REQUIRE(expected.edge_edge.size() > 50);
      require_equal(broad_phase.candidates(), expected);
    }
}

TEST_CASE("each object is inflated by its own radius, its edges too", "[broad_phase]") {
  for (const Scene& scene : all_scenes()) {
    const VecX x = scene.x();
    InflationRadii radii = InflationRadii::uniform(scene.mesh, kRange, kRange);
    const size_t objects = radii.surface.size();
    for (size_t i = 0; i < objects; ++i) {
      radii.surface[i] *= 0.3 + 0.7 * i;
      radii.edge[i] *= 1.3 - 0.4 * i;
    }
    BroadPhase broad_phase(scene.mesh, CollidingObjects());
    REQUIRE(broad_phase.update(x, VecX(), radii, kSkin));
    const Candidates expected = BruteForce(scene.mesh, CollidingObjects(), x, VecX(), radii, kSkin).find();
    REQUIRE(expected.edge_edge.size() > 20);
    require_equal(broad_phase.candidates(), expected);
    REQUIRE_FALSE(broad_phase.update(x, VecX(), radii, kSkin));
    radii.surface.back() *= 1.1;
    REQUIRE(broad_phase.update(x, VecX(), radii, kSkin));
    require_equal(broad_phase.candidates(), BruteForce(scene.mesh, CollidingObjects(), x, VecX(), radii, kSkin).find());
    if (objects > 1) {
      radii.edge.pop_back();
      REQUIRE_THROWS_WITH(broad_phase.update(x, VecX(), radii, kSkin), Catch::Contains("objects"));
    }
  }
}

TEST_CASE("rods and particles give candidates of every kind", "[broad_phase]") {
  const Scene scene = mixed(12, 60);
  BroadPhase broad_phase(scene.mesh, CollidingObjects());
  broad_phase.update(scene.x(), VecX(), 0.1, 0.0);
  const Candidates& found = broad_phase.candidates();
  REQUIRE(!found.point_triangle.empty());
  REQUIRE(!found.point_edge.empty());
  REQUIRE(!found.point_point.empty());
  REQUIRE(found.size() == found.point_triangle.size() + found.edge_edge.size() +
                              found.point_edge.size() + found.point_point.size());
}

TEST_CASE("immovable pairs and excluded objects give no candidates", "[broad_phase]") {
  Scene scene = triangle_soup(150);
  scene.freeze(1);
  scene.mesh.vertex_movable[0] = 0;  // one vertex of a triangle that can still move
  CollidingObjects colliding;
  colliding.set(2, 0, false);
  colliding.set(0, 0, false);
  BroadPhase broad_phase(scene.mesh, colliding);
  broad_phase.update(scene.x(), VecX(), kRange, kSkin);
  const Candidates expected =
      BruteForce(scene.mesh, colliding, scene.x(), VecX(), kRange, kSkin).find();
  REQUIRE(!expected.point_triangle.empty());
  require_equal(broad_phase.candidates(), expected);

  for (const int object : {0, 2}) scene.freeze(object);
  BroadPhase frozen(scene.mesh, CollidingObjects());
  frozen.update(scene.x(), VecX(), kRange, kSkin);
  REQUIRE(frozen.candidates().size() == 0);
}

TEST_CASE("no move inside the fat AABBs brings a new pair into range", "[broad_phase]") {
  std::mt19937 random(5);
  for (const Scene& scene : all_scenes()) {
    const VecX x = scene.x(), p = random_motion(random, x.size(), 0.02);
    BroadPhase broad_phase(scene.mesh, CollidingObjects());
    broad_phase.update(x, p, kRange, kSkin);
    const auto& kept = broad_phase.candidates().edge_edge;
    for (int trial = 0; trial < 5; ++trial) {
      // A point of the box of each vertex: x + t p, t per coordinate, plus up to half the skin.
      const VecX t = 0.5 * (random_motion(random, x.size(), 1.0).array() + 1.0);
      const VecX y = x + t.cwiseProduct(p) + random_motion(random, x.size(), 0.5 * kSkin);
      REQUIRE(broad_phase.covers(y));
      REQUIRE_FALSE(broad_phase.update(y, VecX(), kRange, kSkin));
      const Candidates near =
          BruteForce(scene.mesh, CollidingObjects(), y, VecX(), kRange, 0.0).find();
      REQUIRE(
          std::includes(kept.begin(), kept.end(), near.edge_edge.begin(), near.edge_edge.end()));
    }
    REQUIRE(broad_phase.builds() == 1);
  }
}

TEST_CASE("candidates are rebuilt exactly when they must be", "[broad_phase]") {
  const Scene scene = two_sheets(6, 0.01);
  const VecX x = scene.x(), none;
  BroadPhase broad_phase(scene.mesh, CollidingObjects());
  REQUIRE_FALSE(broad_phase.covers(x));
  REQUIRE(broad_phase.update(x, none, 0.02, 0.01));
  REQUIRE_FALSE(broad_phase.update(x, none, 0.02, 0.01));
  REQUIRE_FALSE(broad_phase.update(x, none, 0.01, 0.01));  // a smaller range is a subset
  VecX p = VecX::Zero(x.size());
  p[7] = 0.0049;
  REQUIRE_FALSE(broad_phase.update(x, p, 0.02, 0.01));
  REQUIRE_FALSE(broad_phase.update(x + p, none, 0.02, 0.01));
  p[7] = -0.0051;
  REQUIRE_FALSE(broad_phase.covers(x + p));
  REQUIRE(broad_phase.update(x, p, 0.02, 0.01));
  REQUIRE(broad_phase.covers(x + p));
  REQUIRE(broad_phase.update(x, none, 0.03, 0.01));
  REQUIRE(broad_phase.builds() == 3);
}

TEST_CASE("objects outside their fat AABBs are searched alone, and no pair is missed", "[broad_phase]") {
  std::mt19937 random(11);
  for (Scene scene : {triangle_soup(150), mixed(12, 60)}) {
    scene.freeze(1);
    VecX x = scene.x();
    BroadPhase kept(scene.mesh, CollidingObjects());
    kept.update(x, VecX(), kRange, kSkin);
    for (int step = 0; step < 6; ++step) {
      const VecX way = random_motion(random, x.size(), 0.05);
      for (Eigen::Index v = 0; v < x.size() / 3; ++v)
        if (scene.mesh.vertex_object[v] == 0) x.segment<3>(3 * v) += way.segment<3>(3 * v);
      REQUIRE(kept.update(x, VecX(), kRange, kSkin));
      REQUIRE(kept.covers(x));
      const Candidates near = BruteForce(scene.mesh, CollidingObjects(), x, VecX(), kRange, 0.0).find();
      const auto holds = [](const auto& all, const auto& some) { return std::includes(all.begin(), all.end(), some.begin(), some.end()); };
      REQUIRE(holds(kept.candidates().edge_edge, near.edge_edge));
      REQUIRE(holds(kept.candidates().point_edge, near.point_edge));
      REQUIRE(holds(kept.candidates().point_point, near.point_point));
      for (const auto& pair : near.point_triangle)
        REQUIRE(std::count(kept.candidates().point_triangle.begin(), kept.candidates().point_triangle.end(), pair) == 1);
      REQUIRE(near.edge_edge.size() > 20);
    }
  }
}

TEST_CASE("interior vertices have no fat AABB to leave", "[broad_phase]") {
  Scene scene = two_sheets(6, 0.01);
  const int inside = scene.add_vertex(Vec3(0.5, 0.5, 0.005), 0);
  scene.mesh.vertices.pop_back();
  VecX x = scene.x();
  BroadPhase broad_phase(scene.mesh, CollidingObjects());
  broad_phase.update(x, VecX(), 0.02, 0.0);
  x[3 * inside] = 100.0;
  REQUIRE_FALSE(broad_phase.update(x, VecX(), 0.02, 0.0));
}

TEST_CASE("refitted trees find the candidates of new trees", "[broad_phase]") {
  std::mt19937 random(9);
  for (const Scene& scene : all_scenes()) {
    VecX x = scene.x();
    BroadPhase kept(scene.mesh, CollidingObjects());
    for (int step = 0; step < 6; ++step) {  // from small moves to a shuffle
      kept.update(x, VecX(), kRange, kSkin);
      BroadPhase new_candidates(scene.mesh, CollidingObjects());
      new_candidates.update(x, VecX(), kRange, kSkin);
      require_equal(kept.candidates(), new_candidates.candidates());
      x += random_motion(random, x.size(), 0.01 * (1 << step));
    }
    REQUIRE(kept.builds() == 6);
  }
}

TEST_CASE("candidates are the same for one and two threads", "[broad_phase]") {
  const Scene scene = two_sheets(40, 0.001);
  std::vector<Candidates> found;
  for (const std::size_t threads : {1, 2}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    BroadPhase broad_phase(scene.mesh, CollidingObjects());
    broad_phase.update(scene.x(), VecX(), 0.005, 0.0);
    found.push_back(broad_phase.candidates());
  }
  REQUIRE(found[0].size() > 1000);
  require_equal(found[0], found[1]);
}

TEST_CASE("no object at all, and a range beyond all distances", "[broad_phase]") {
  const CollisionMesh empty;
  BroadPhase nothing(empty, CollidingObjects());
  REQUIRE(nothing.update(VecX(), VecX(), 0.1, 0.1));
  REQUIRE(nothing.candidates().size() == 0);

  const Scene scene = triangle_soup(20);
  BroadPhase broad_phase(scene.mesh, CollidingObjects());
  broad_phase.update(scene.x(), VecX(), 10.0, 0.0);
  REQUIRE(broad_phase.candidates().point_triangle.size() == 60 * 19);
  REQUIRE(broad_phase.candidates().edge_edge.size() == 60 * 57 / 2);
}

TEST_CASE("bad input to the broad phase is refused", "[broad_phase]") {
  const Scene scene = two_sheets(4, 0.01);
  VecX x = scene.x();
  BroadPhase broad_phase(scene.mesh, CollidingObjects());
  REQUIRE_THROWS_AS(broad_phase.update(VecX::Zero(5), VecX(), 0.1, 0.0), InputError);
  REQUIRE_THROWS_AS(broad_phase.update(x, VecX::Zero(5), 0.1, 0.0), InputError);
  REQUIRE_THROWS_AS(broad_phase.update(x, VecX(), -0.1, 0.0), InputError);
  REQUIRE_THROWS_AS(broad_phase.update(x, VecX(), 0.1, -1.0), InputError);
  x[4] = std::numeric_limits<double>::quiet_NaN();
  REQUIRE_THROWS_WITH(broad_phase.update(x, VecX(), 0.1, 0.0), Catch::Contains("vertex 1"));
  REQUIRE(broad_phase.builds() == 0);
}
