// Groups of candidates by point and object: every candidate is in one group, of its point and its
// object, and groups ascend.
#include "geometry/broad_phase/point_groups.hpp"

#include <catch2/catch.hpp>
#include <algorithm>

#include "geometry/broad_phase/candidates.hpp"
#include "tests/framework/contact/surface_builder.hpp"

using namespace tack;

namespace {

// Triangles, rods and particles of objects 0 to 3, and all of their candidates with a probability.
struct Case {
  CollisionMesh mesh;
  Candidates candidates;

  Case(double probability, unsigned seed) {
    RandomPoints random(seed);
    SurfaceBuilder builder;
    for (int object = 0; object < 3; ++object)
      for (int i = 0; i < 6; ++i) builder.add_triangle(random.point(1), random.point(1), random.point(1), object);
    for (int object = 0; object < 3; ++object) builder.add_rod({random.point(1), random.point(1), random.point(1)}, object, 0.1);
    for (int i = 0; i < 5; ++i) builder.add_particle(random.point(1), 3, 0.1);
    mesh = builder.surface().mesh;
    const auto take = [&] { return random.uniform(0, 1) < probability; };
    for (const int v : mesh.vertices) {
      for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
        if (take()) candidates.point_triangle.push_back({v, t});
      for (const int e : mesh.codim_edges)
        if (take()) candidates.point_edge.push_back({v, e});
    }
    for (const int v : mesh.codim_points)
      for (const int w : mesh.codim_points)
        if (v < w && take()) candidates.point_point.push_back({v, w});
  }
};

}  // namespace

TEST_CASE("every candidate is in the one group of its point and its object", "[contact][groups]") {
  for (const double probability : {0.02, 0.3, 1.0})
    for (const unsigned seed : {1u, 2u}) {
      const Case c(probability, seed);
      PointGroups groups;
      groups.make(c.candidates, c.mesh);
      size_t triangles = 0, edges = 0, others = 0;
      for (const PointGroup& g : groups.all) {
        for (int i = g.triangle_begin; i < g.triangle_end; ++i, ++triangles) {
          const auto& [v, t] = c.candidates.point_triangle[i];
          CHECK(std::array{v, c.mesh.vertex_object[c.mesh.triangles[t][0]]} == g.key());
        }
        for (int i = g.edge_begin; i < g.edge_end; ++i, ++edges) {
          const auto& [v, e] = c.candidates.point_edge[i];
          CHECK(std::array{v, c.mesh.vertex_object[c.mesh.edges[e][0]]} == g.key());
        }
        for (int i = g.other_begin; i < g.other_end; ++i, ++others) {
          const auto& [v, w] = groups.particles[i];
          CHECK(std::array{v, c.mesh.vertex_object[w]} == g.key());
        }
      }
      // The groups are disjoint: their keys differ, and their sizes add up to the lists.
      CHECK(triangles == c.candidates.point_triangle.size());
      CHECK(edges == c.candidates.point_edge.size());
      CHECK(others == 2 * c.candidates.point_point.size());
      for (size_t i = 1; i < groups.all.size(); ++i) CHECK(groups.all[i - 1].key() < groups.all[i].key());
    }
}

TEST_CASE("particle candidates appear in both directions, sorted", "[contact][groups]") {
  const Case c(0.6, 3);
  PointGroups groups;
  groups.make(c.candidates, c.mesh);
  CHECK(std::is_sorted(groups.particles.begin(), groups.particles.end()));
  for (const auto& [v, w] : c.candidates.point_point) {
    CHECK(std::count(groups.particles.begin(), groups.particles.end(), std::array{v, w}) == 1);
    CHECK(std::count(groups.particles.begin(), groups.particles.end(), std::array{w, v}) == 1);
  }
}

TEST_CASE("groups of many candidates are equal to those of one pass, whatever the chunks", "[contact][groups]") {
  // More candidates than a chunk of 8192, whose groups straddle the ends of chunks.
  CollisionMesh mesh;
  Candidates candidates;
  for (int v = 0; v < 90; ++v) mesh.vertex_object.push_back(v / 30);
  for (int t = 0; t < 300; ++t) mesh.triangles.push_back({t / 100 * 30, t / 100 * 30 + 1, t / 100 * 30 + 2});
  for (int v = 0; v < 90; ++v)
    for (int t = 0; t < 300; ++t) candidates.point_triangle.push_back({v, t});
  PointGroups groups;
  groups.make(candidates, mesh);
  REQUIRE(groups.all.size() == 270);
  for (int i = 0; i < 270; ++i) {
    const PointGroup& g = groups.all[i];
    CHECK(g.key() == std::array{i / 3, i % 3});
    CHECK(g.triangle_begin == 100 * i);
    CHECK(g.triangle_end == 100 * (i + 1));
  }
}

TEST_CASE("groups know where they were in the list before", "[contact][groups]") {
  const Case c(0.5, 4);
  RandomPoints random(5);
  Candidates fewer;
  fewer.point_edge = c.candidates.point_edge;
  for (const auto& pair : c.candidates.point_triangle)
    if (random.uniform(0, 1) < 0.2) fewer.point_triangle.push_back(pair);
  // By vertex, then object, then triangle, as the lists of a search are.
  const std::array<const Candidates*, 2> lists{&c.candidates, &fewer};
  for (const bool fewer_first : {false, true}) {
    const Candidates *first = lists[fewer_first], *second = lists[!fewer_first];
    PointGroups groups;
    groups.make(*first, c.mesh);
    for (const PointGroup& g : groups.all) CHECK(g.before == -1);
    const std::vector<PointGroup> before = groups.all;
    groups.make(*second, c.mesh);
    size_t known = 0;
    for (const PointGroup& g : groups.all) {
      const auto at = std::find_if(before.begin(), before.end(), [&](const PointGroup& b) { return b.key() == g.key(); });
      REQUIRE((g.before >= 0) == (at != before.end()));
      if (g.before < 0) continue;
      ++known;
      CHECK(&before[g.before] == &*at);
      CHECK(g.triangle_begin == at->triangle_begin + g.triangle_shift);
    }
    CHECK(known > 10);
  }
}

TEST_CASE("no candidates make no groups", "[contact][groups]") {
  PointGroups groups;
  groups.make({}, {});
  CHECK(groups.all.empty());
  CHECK(groups.particles.empty());
}
