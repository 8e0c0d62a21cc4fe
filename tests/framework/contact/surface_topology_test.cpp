// Topology of contact surfaces: incidence is its own inverse, and an edge is smooth if two triangles
// meet there at a small angle.
#include "framework/contact/surface/surface_topology.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <set>

#include "tests/framework/contact/surface_builder.hpp"

using namespace tack;

namespace {

// Two triangles that share the y axis; the second one is folded up by an angle.
SurfaceBuilder fold(double angle) {
  SurfaceBuilder s;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0.5, 0), Vec3(std::cos(angle), 0.4, std::sin(angle))}) s.add_vertex(p, 0);
  s.add_triangle({0, 1, 2});
  s.add_triangle({1, 0, 3});
  return s;
}

SurfaceBuilder grid(int n, double noise, unsigned seed) {
  RandomPoints random(seed);
  SurfaceBuilder s;
  s.add_grid({n, n}, 0, [&](double u, double v) { return Vec3(Vec3(u, v, 0) + random.point(noise)); });
  return s;
}

int sides_of(const SurfaceTopology& topology, int triangles) {
  int smooth = 0;
  for (int t = 0; t < triangles; ++t)
    for (int i = 0; i < 3; ++i) smooth += topology.smooth_edge(t, i);
  return smooth;
}

}  // namespace

TEST_CASE("triangles at a vertex are those that have it as a corner, ascending", "[contact][topology]") {
  SurfaceBuilder s = grid(5, 0.05, 1);
  s.add_box({2, 0, 0}, {3, 1, 1}, 1);
  const ContactSurface surface = s.surface();
  const SurfaceTopology topology(surface);
  size_t uses = 0;
  for (const int v : surface.mesh.vertices) {
    std::vector<int> expected;
    for (size_t t = 0; t < surface.mesh.triangles.size(); ++t)
      if (std::count(surface.mesh.triangles[t].begin(), surface.mesh.triangles[t].end(), v)) expected.push_back(static_cast<int>(t));
    const auto at = topology.triangles_at(v);
    CHECK(std::vector<int>(at.begin(), at.end()) == expected);
    uses += at.size();
  }
  CHECK(uses == 3 * surface.mesh.triangles.size());
}

TEST_CASE("every edge is visited once, with all triangles that have it", "[contact][topology]") {
  SurfaceBuilder s = grid(4, 0.02, 2);
  s.add_triangle({6, 7, s.add_vertex({0.3, 0.2, 1}, 0)});  // a third triangle at an inner edge
  const ContactSurface surface = s.surface();
  std::set<Edge> seen;
  size_t uses = 0;
  for_each_edge(surface, [&](std::span<const EdgeUse> at, const std::optional<double>& angle) {
    CHECK(seen.insert(at[0].edge).second);
    CHECK(at[0].edge[0] < at[0].edge[1]);
    uses += at.size();
    for (const EdgeUse& use : at) {
      const Triangle& t = surface.mesh.triangles[use.triangle];
      const int a = t[use.side], b = t[(use.side + 1) % 3];
      CHECK(use.edge == Edge{std::min(a, b), std::max(a, b)});
    }
    if (at.size() != 2) CHECK_FALSE(angle);
  });
  CHECK(uses == 3 * surface.mesh.triangles.size());
  CHECK(seen.size() == surface.mesh.edges.size());
}

TEST_CASE("the angle of a smooth edge is that between the normals, folded up or down", "[contact][topology]") {
  for (const double degrees : {0.0, 1.0, 10.0, 39.0})
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> angles;
      const ContactSurface surface = fold(sign * degrees / 180 * M_PI).surface();
      for_each_edge(surface, [&](std::span<const EdgeUse>, const std::optional<double>& angle) {
        if (angle) angles.push_back(*angle);
      });
      REQUIRE(angles.size() == 1);
      CHECK(angles[0] == Approx(degrees / 180 * M_PI).margin(1e-7));
    }
}

TEST_CASE("pins the crease angle: an edge is smooth below 40 degrees", "[contact][topology]") {
  for (const auto& [degrees, smooth] : {std::pair(39.9, true), std::pair(40.1, false), std::pair(90.0, false), std::pair(179.0, false)}) {
    const ContactSurface surface = fold(degrees / 180 * M_PI).surface();
    const SurfaceTopology topology(surface);
    INFO(degrees);
    CHECK(topology.smooth_edge(0, 0) == smooth);
    CHECK(topology.smooth_edge(1, 0) == smooth);
    CHECK(sides_of(topology, 2) == (smooth ? 2 : 0));  // boundary edges are never smooth
  }
}

TEST_CASE("a vertex is smooth if all of its edges are: inside a flat grid, not on its boundary", "[contact][topology]") {
  const int n = 5;
  const ContactSurface surface = grid(n, 0, 3).surface();
  const SurfaceTopology topology(surface);
  for (int v = 0; v < (n + 1) * (n + 1); ++v) {
    const int i = v % (n + 1), j = v / (n + 1);
    CHECK(topology.smooth_vertex(v) == (i > 0 && i < n && j > 0 && j < n));
  }
  // Two triangles see each inner edge; the boundary has 4 n edges.
  CHECK(sides_of(topology, 2 * n * n) == 3 * 2 * n * n - 4 * n);
}

TEST_CASE("a box has twelve creases, six smooth diagonals and no smooth vertex", "[contact][topology]") {
  SurfaceBuilder s;
  s.add_box({0, 0, 0}, {1, 2, 3}, 0);
  const ContactSurface surface = s.surface();
  const SurfaceTopology topology(surface);
  CHECK(sides_of(topology, 12) == 2 * 6);
  for (int v = 0; v < 8; ++v) CHECK_FALSE(topology.smooth_vertex(v));
}

TEST_CASE("topology does not depend on rotation, on renumbering, or on the rotation of corners", "[contact][topology]") {
  RandomPoints random(4);
  const SurfaceBuilder s = grid(4, 0.09, 5);
  const ContactSurface surface = s.surface();
  const SurfaceTopology topology(surface);
  CHECK(sides_of(topology, 32) > 0);
  CHECK(sides_of(topology, 32) < 96 - 16);  // the noise makes creases
  // A permutation of the triangles, each with its corners shifted.
  std::vector<int> order(surface.mesh.triangles.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  for (size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[static_cast<size_t>(random.index(static_cast<int>(i) + 1))]);
  ContactSurface other = surface;
  other.rest = moved(surface.rest, random.rotation(), random.point(5));
  for (size_t i = 0; i < order.size(); ++i) {
    const Triangle& t = surface.mesh.triangles[order[i]];
    const int shift = static_cast<int>(i % 3);
    other.mesh.triangles[i] = {t[shift], t[(shift + 1) % 3], t[(shift + 2) % 3]};
  }
  const SurfaceTopology again(other);
  for (size_t i = 0; i < order.size(); ++i)
    for (int side = 0; side < 3; ++side)
      CHECK(again.smooth_edge(static_cast<int>(i), side) == topology.smooth_edge(order[i], static_cast<int>((side + i) % 3)));
  for (const int v : surface.mesh.vertices) CHECK(again.smooth_vertex(v) == topology.smooth_vertex(v));
}

TEST_CASE("rods and particles are codimensional, vertices of triangles are not", "[contact][topology]") {
  SurfaceBuilder s = grid(2, 0, 6);
  const int rod = s.add_rod({{0, 0, 1}, {1, 0, 1}, {2, 0, 1}}, 1, 0.1);
  const int particle = s.add_particle({5, 5, 5}, 2, 0.3);
  const ContactSurface surface = s.surface();
  const SurfaceTopology topology(surface);
  for (int v = 0; v < 9; ++v) CHECK_FALSE(topology.is_codimensional(v));
  CHECK(topology.rods_at(rod).size() == 1);
  CHECK(topology.rods_at(rod + 1).size() == 2);
  CHECK(topology.rods_at(rod + 2).size() == 1);
  CHECK(topology.is_codimensional(rod));
  CHECK(topology.particle_radius(rod) == 0);
  CHECK(topology.is_codimensional(particle));
  CHECK(topology.particle_radius(particle) == 0.3);
  CHECK(topology.rods_at(particle).empty());
  // Without rods and particles, nothing is codimensional.
  const ContactSurface plain = grid(2, 0, 6).surface();
  const SurfaceTopology of_plain(plain);
  for (int v = 0; v < 9; ++v) CHECK_FALSE(of_plain.is_codimensional(v));
}

TEST_CASE("sheets have two sides, surfaces of solids one", "[contact][topology]") {
  SurfaceBuilder s;
  const int solid = s.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0), sheet = s.add_triangle({0, 0, 1}, {1, 0, 1}, {0, 1, 1}, 1, true);
  const ContactSurface surface = s.surface();
  const SurfaceTopology topology(surface);
  CHECK_FALSE(topology.two_sided(solid));
  CHECK(topology.two_sided(sheet));
}
