// Regions of surfaces: a triangle is in the region whose roles hold for it, and a region surrounds
// an edge or a vertex if it has all triangles there.
#include "framework/contact/surface/surface_region.hpp"

#include <catch2/catch.hpp>
#include <algorithm>

#include "framework/contact/stencils/rest_neighbours.hpp"
#include "tests/framework/contact/surface_builder.hpp"

using namespace tack;

namespace {

constexpr int n = 6;

// Object 0 is one triangle, object 1 a grid. Vertices of the grid with x <= 1/2 are in the set 1, those with y <= 1/2 in the set 2.
struct Regions {
  Regions() : at(builder()) {
    std::vector<RegionSet> sets;
    for (size_t v = 0; v < at.surface.mesh.vertex_object.size(); ++v) {
      const Vec3 p = vertex(at.surface.rest, static_cast<int>(v));
      sets.push_back(at.surface.mesh.vertex_object[v] == 0 ? 4 : (p.x() <= 0.5 ? 1 : 0) + (p.y() <= 0.5 ? 2 : 0));
    }
    pairs.set_regions(sets);
    RegionRoles both, left;  // the first that applies holds
    both.first = 4;
    both.second = 3;
    left.second = 1;
    pairs.add_region_roles(0, 1, both);
    pairs.add_region_roles(0, 1, left);
  }
  static SurfaceBuilder builder() {
    SurfaceBuilder b;
    b.add_triangle({0, 0, 1}, {0, 1, 1}, {1, 0, 1}, 0);
    b.add_rectangle({n, n}, 1, {0, 0, 0}, 1, 1);
    return b;
  }
  SurfaceRegion region(int region_pair) const { return {pairs, at.surface.mesh, 0, 1, region_pair}; }
  // The region pair of a triangle by its corners.
  int expected(int triangle) const {
    bool left = true, low = true;
    for (const Vec3& p : corners(at.surface.rest, at.surface.mesh.triangles[triangle])) {
      left = left && p.x() <= 0.5;
      low = low && p.y() <= 0.5;
    }
    return left && low ? 0 : left ? 1 : -1;
  }

  SurfaceAt at;
  PairTable pairs{2};
};

}  // namespace

TEST_CASE("each triangle is in the one region whose roles are the first to apply", "[contact][regions]") {
  const Regions r;
  std::array<int, 3> count{};
  for (int t = 1; t <= 2 * n * n; ++t)
    for (int pair = -1; pair < 2; ++pair) {
      CHECK(r.region(pair).contains(t) == (r.expected(t) == pair));
      count[pair + 1] += r.region(pair).contains(t);
    }
  // Half of the grid is on the left, a quarter low on the left.
  CHECK(count == std::array{n * n, n * n / 2, n * n / 2});
}

TEST_CASE("a region surrounds the vertices and edges all of whose triangles it contains, by brute force", "[contact][regions]") {
  const Regions r;
  const SurfaceTopology topology(r.at.surface);
  const auto& triangles = r.at.surface.mesh.triangles;
  int surrounded = 0;
  for (int pair = -1; pair < 2; ++pair) {
    const SurfaceRegion region = r.region(pair);
    const auto all_with = [&](std::initializer_list<int> vertices) {
      for (int t = 1; t < static_cast<int>(triangles.size()); ++t)
        if (std::all_of(vertices.begin(), vertices.end(), [&](int v) { return std::count(triangles[t].begin(), triangles[t].end(), v) > 0; }) && r.expected(t) != pair) return false;
      return true;
    };
    for (int v = 3; v < 3 + (n + 1) * (n + 1); ++v) {
      CHECK(region.surrounds_vertex(topology, v) == all_with({v}));
      surrounded += all_with({v});
    }
    for (int t = 1; t < static_cast<int>(triangles.size()); ++t)
      for (int side = 0; side < 3; ++side) CHECK(region.surrounds_edge(topology, t, side) == all_with({triangles[t][side], triangles[t][(side + 1) % 3]}));
  }
  CHECK(surrounded > n);
}

TEST_CASE("primitives of one object are close at rest within the range, those of two objects and particles never", "[contact][rest]") {
  SurfaceBuilder builder;
  builder.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0);
  const int above = builder.add_vertex({0.2, 0.2, 0.5}, 0), other = builder.add_vertex({0.2, 0.2, 0.1}, 1);
  builder.add_triangle({above, builder.add_vertex({3, 3, 3}, 0), builder.add_vertex({3, 4, 3}, 0)});
  for (int i = 0; i < 2; ++i) builder.add_particle({0.2, 0.2, 0.1 + 0.1 * i}, 2, 0.01);
  const ContactSurface surface = builder.surface();
  const Triangle face = surface.mesh.triangles[0];
  CHECK(close_at_rest(surface, std::array{above}, face, 0.51));
  CHECK_FALSE(close_at_rest(surface, std::array{above}, face, 0.49));
  CHECK_FALSE(close_at_rest(surface, std::array{other}, face, 9));
  const auto& particles = surface.mesh.codim_points;
  CHECK_FALSE(close_at_rest(surface, std::array{particles[0]}, std::array{particles[1]}, 9));
  CHECK(rest_neighbours(surface, std::array{above}, face, 0.51));  // without gaps at rest all that is close are neighbours
  PairTable pairs(3);
  pairs.set_offset(0, 0, 0.2);
  pairs.set_offset(0, 1, 0.3);
  pairs.set_offset(2, 2, 0.4);
  PairRole edge;
  edge.range = 0.51;
  pairs.set_edge(0, 0, edge);
  CHECK(offset_between(surface, pairs, std::array{above}, face) == 0);
  CHECK(offset_between(surface, pairs, std::array{other}, face) == 0.3);
  CHECK(offset_between(surface, pairs, std::array{particles[0]}, std::array{particles[1]}) == 0.4);
  pairs.set_edge(0, 0, PairRole());
  CHECK(offset_between(surface, pairs, std::array{above}, face) == 0.2);
}
