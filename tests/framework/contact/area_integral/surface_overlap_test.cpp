// Overlap of two surfaces at the start of a step: its area is that of the common rectangle, and
// triangles out of range are subdivided only when they may have come near.
#include "framework/contact/area_integral/surface_overlap.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/distance/triangle_triangle.hpp"
#include "tests/framework/contact/flat_law.hpp"
#include "tests/framework/contact/surface_builder.hpp"

using namespace tack;

namespace {

constexpr double range = 0.1;  // m

// Two rectangles: object 0 faces down on object 1, the unit square in z = 0.
struct Setup {
  std::array<int, 2> cells = {4, 4}, cells_below = {3, 5};
  Vec3 corner = {0, 0, 0.05};
  double width = 1, depth = 1;
  bool by_overlap = false;
};

struct Overlap {
  // turn: of object 0 about the point (1, 0.5) of both, before all is rotated and translated [rad].
  explicit Overlap(const Setup& setup, const Mat3& rotation = Mat3::Identity(), const Vec3& offset = Vec3::Zero(), double turn = 0) {
    builder.add_rectangle(setup.cells, 0, setup.corner, setup.width, setup.depth, false);
    builder.add_rectangle(setup.cells_below, 1, {0, 0, 0}, 1, 1);
    VecX flat = builder.x();
    if (turn != 0)
      for (int v = 0; v < flat.size() / 3; ++v)
        if (builder.scene.mesh.vertex_object[v] == 0) {
          const Vec3 arm = vertex(flat, v) - Vec3(1, 0.5, 0);
          vertex(flat, v) += Vec3(-std::sin(turn) * arm.y() + (std::cos(turn) - 1) * arm.x(), std::sin(turn) * arm.x() + (std::cos(turn) - 1) * arm.y(), 0);
        }
    x = moved(flat, rotation, offset);
    at = std::make_unique<SurfaceAt>(builder, x);
    PairRole role{pairs.add_law(flat_law(range)), 1, range, true};
    pairs.point(0, 1) = role;
    if (setup.by_overlap) pairs.point(1, 0) = role;
    for (const auto& [a, b] : {std::pair(0, 1), {1, 0}}) {
      if (pairs.point(a, b).law < 0) continue;
      rules.of(a, b).carries_pressure = rules.of(a, b).overlap_only = true;
      rules.of(a, b).by_overlap = setup.by_overlap;
    }
    sides = std::make_unique<IntegrationSides>(pairs, rules);
    overlap = std::make_unique<SurfaceOverlap>(at->surface, pairs, rules, at->lagged);
    broad_phase = std::make_unique<BroadPhase>(at->surface.mesh, CollidingObjects());
    broad_phase->update(x, {}, 2 * range, 0.01);
    PatchFinder finder(at->surface.mesh, at->lagged);
    const auto& object = at->surface.mesh.vertex_object;
    std::array<std::vector<int>, 2> triangles;
    for (int t = 0; t < static_cast<int>(at->surface.mesh.triangles.size()); ++t) triangles[object[at->surface.mesh.triangles[t][0]]].push_back(t);
    for (const int v : at->surface.mesh.vertices) {
      const auto& opposite = triangles[1 - object[v]];
      groups.push_back({v, 1 - object[v], finder.find(finder.at_vertex(v), static_cast<int>(opposite.size()), [&](int i) { return opposite[i]; })});
    }
    if (setup.by_overlap) overlap->choose_sides(groups, *sides);
    overlap->evaluate(*sides, *broad_phase, groups);
  }
  // Returns the area of the patches of the secondary side.
  double area_at_vertices() const {
    double sum = 0;
    for (const GroupPatches& g : groups)
      if (sides->integrates(at->surface.mesh.vertex_object[g.point], g.object))
        for (int k = 0; k < g.visible.count; ++k) sum += g.visible.patches[k].area;
    return sum;
  }
  double area_of_interior_points() const {
    double sum = 0;
    for (const InteriorPoint& s : overlap->interior_points()) sum += s.area;
    return sum;
  }
  double area() const { return area_at_vertices() + area_of_interior_points(); }
  // The start, with object 0 moved.
  VecX shifted(const Vec3& by) const {
    VecX y = x;
    for (const int v : at->surface.mesh.vertices)
      if (at->surface.mesh.vertex_object[v] == 0) vertex(y, v) += by;
    return y;
  }

  SurfaceBuilder builder;
  VecX x;
  std::unique_ptr<SurfaceAt> at;
  PairTable pairs{2};
  IntegrationRules rules{pairs.classes()};
  std::unique_ptr<IntegrationSides> sides;
  std::unique_ptr<BroadPhase> broad_phase;
  std::unique_ptr<SurfaceOverlap> overlap;
  std::vector<GroupPatches> groups;
};

// Returns the length of the overlap boundary whose outward normal is within 45 degrees of a direction [m].
double boundary_length(const Overlap& overlap, const Vec3& direction) {
  const CollisionMesh& mesh = overlap.at->surface.mesh;
  double sum = 0;
  for (const OverlapFacets& pair : overlap.overlap->facets())
    for (const OverlapBoundaryEdge& edge : pair.boundary_edges) {
      const Triangle& t = mesh.triangles[edge.other];
      const Vec3 along = vertex(overlap.x, t[(edge.side + 1) % 3]) - vertex(overlap.x, t[edge.side]);
      if (along.cross(overlap.at->lagged.normal(edge.other)).normalized().dot(direction) > 0.71) sum += edge.length;
    }
  return sum;
}

double common(const Setup& s) {
  const auto length = [](double from, double size) { return std::max(0.0, std::min(1.0, from + size) - std::max(0.0, from)); };
  return length(s.corner.x(), s.width) * length(s.corner.y(), s.depth);
}

}  // namespace

TEST_CASE("the overlap of two rectangles is the common rectangle, whatever the shift and the meshes", "[contact][overlap]") {
  for (const std::array<int, 2> cells : {std::array{1, 1}, std::array{4, 4}, std::array{7, 3}})
    for (const Vec3& corner : {Vec3(0, 0, 0.05), Vec3(0.31, -0.17, 0.05), Vec3(-0.77, 0.4, 0.09), Vec3(0.25, 0.25, 0.01), Vec3(0.9999, 0, 0.05), Vec3(1.5, 0, 0.05)})
      for (const double width : {1.0, 0.37}) {
        const Setup setup{.cells = cells, .corner = corner, .width = width, .depth = 0.8};
        const Overlap overlap(setup);
        INFO(cells[0] << " cells at " << corner.transpose() << ", " << width);
        CHECK(overlap.area() == Approx(common(setup)).margin(1e-6));
        double facets = 0;
        for (const OverlapFacets& pair : overlap.overlap->facets())
          for (const OverlapFacet& f : pair.facets) facets += f.area;
        CHECK(facets == Approx(overlap.area()).margin(1e-9));
      }
}

// The boundary x = 1 of the lower surface runs along a line of the upper one, but for an offset or an angle.
TEST_CASE("a boundary along lines of the other mesh has its length, whatever round-off does", "[contact][overlap]") {
  RandomPoints random(2);
  for (const std::array<int, 2> cells : {std::array{4, 4}, std::array{6, 1}, std::array{2, 5}, std::array{10, 3}})
    for (const double scale : {0.0, 1e-16, 1e-12, 1e-10, 3e-10, 1e-9, 1e-8, 1e-6, 1e-4})
      for (const double sign : {1.0, -1.0})
        for (const bool turned : {false, true}) {
          const double by = sign * scale;
          const Setup setup{.cells = cells, .corner = {0.5 + (turned ? 0 : by), -0.17, 0.08}, .depth = 0.8};
          for (int trial = 0; trial < 3; ++trial) {
            const Mat3 all = trial == 0 ? Mat3::Identity() : random.rotation();
            const Overlap overlap(setup, all, trial == 0 ? Vec3::Zero() : random.point(2), turned ? by : 0);
            INFO(cells[0] << " x " << cells[1] << " cells, " << (turned ? "turned" : "shifted") << " by " << by << ", trial " << trial);
            CHECK(boundary_length(overlap, all * Vec3::UnitX()) == Approx(0.63).margin(1e-3 * std::max(1e-3, scale / 1e-4)));
            CHECK(overlap.area() == Approx(0.63 * 0.5).margin(1e-6 + scale));
          }
        }
}

TEST_CASE("the overlap does not depend on rotation and translation", "[contact][overlap]") {
  RandomPoints random(1);
  const Setup setup{.corner = {0.31, -0.17, 0.05}};
  for (int trial = 0; trial < 5; ++trial) CHECK(Overlap(setup, random.rotation(), random.point(2)).area() == Approx(common(setup)).margin(1e-6));
}

TEST_CASE("a triangle that overlaps as a whole gives a third of its area to each corner, without an interior point", "[contact][overlap]") {
  const Overlap overlap(Setup{.cells = {8, 8}, .corner = {0, 0, 0.05}});
  CHECK(overlap.overlap->interior_points().empty());
  for (const GroupPatches& g : overlap.groups) {
    if (g.object != 1) continue;
    REQUIRE(g.visible.count == 1);
    CHECK(g.visible.patches[0].area == Approx(overlap.at->lagged.tributary_area(g.point)));
  }
}

TEST_CASE("interior points are sorted by triangle and cell, and lie where they overlap", "[contact][overlap]") {
  const Overlap overlap(Setup{.corner = {0.31, -0.17, 0.05}});
  const auto& points = overlap.overlap->interior_points();
  REQUIRE(points.size() > 10);
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = point_inside(overlap.x, overlap.at->surface.mesh.triangles[points[i].triangle], points[i].inside);
    CHECK(p.x() <= 1 + 1e-9);
    CHECK(p.y() >= -1e-9);
    if (i > 0) CHECK(std::array{points[i - 1].triangle, points[i - 1].cell} < std::array{points[i].triangle, points[i].cell});
  }
}

TEST_CASE("the side with the larger overlap of whole triangles integrates", "[contact][overlap]") {
  // The small rectangle lies above the square with all of its triangles, of which few lie below it as a whole.
  const Overlap small(Setup{.corner = {0.3, 0.3, 0.05}, .width = 0.4, .depth = 0.4, .by_overlap = true});
  CHECK(small.sides->integrates(0, 1));
  CHECK_FALSE(small.sides->integrates(1, 0));
  CHECK(small.area() == Approx(0.16).margin(1e-6));
  const Overlap large(Setup{.corner = {-1, -1, 0.05}, .width = 3, .depth = 3, .by_overlap = true});
  CHECK(large.sides->integrates(1, 0));
  CHECK(large.area() == Approx(1).margin(1e-6));
}

TEST_CASE("deferred triangles are subdivided when they may have come into range, not before", "[contact][overlap]") {
  const Setup setup{.corner = {0.31, -0.17, 1.5 * range}};
  Overlap overlap(setup);
  const double at_vertices = overlap.area_at_vertices();
  CHECK(overlap.overlap->interior_points().empty());
  CHECK(at_vertices < 0.9 * common(setup));
  // No motion, too little motion, and a common motion subdivide no triangle.
  CHECK(overlap.overlap->subdivide_approached(overlap.x).empty());
  CHECK(overlap.overlap->subdivide_approached(overlap.shifted({0, 0, -0.49 * range})).empty());
  CHECK(overlap.overlap->subdivide_approached(moved(overlap.x, Mat3::Identity(), {3, 2, 1})).empty());
  CHECK(overlap.overlap->interior_points().empty());
  const auto indices = overlap.overlap->subdivide_approached(overlap.shifted({0, 0, -0.51 * range}));
  CHECK(indices.size() == overlap.overlap->interior_points().size());
  for (size_t i = 0; i < indices.size(); ++i) CHECK(indices[i] == static_cast<int>(i));
  CHECK(overlap.area() == Approx(common(setup)).margin(1e-6));
  // They are subdivided once.
  CHECK(overlap.overlap->subdivide_approached(overlap.shifted({0, 0, -1.2 * range})).empty());
}

TEST_CASE("deferred subdivision gives the interior points of the start of the step, whatever the path", "[contact][overlap]") {
  const Setup setup{.corner = {0.31, -0.17, 1.5 * range}};
  RandomPoints random(2);
  Overlap all(setup);
  all.overlap->subdivide_approached(all.shifted({0, 0, -1.4 * range}));
  Overlap overlap(setup);
  size_t rounds = 0;
  for (int trial = 0; trial < 12; ++trial) {
    VecX y = overlap.x;
    for (const int v : overlap.at->surface.mesh.vertices)
      if (overlap.at->surface.mesh.vertex_object[v] == 0) vertex(y, v).z() -= random.uniform(0, 0.1 * trial) * range;
    const auto known = overlap.overlap->interior_points();
    const auto indices = overlap.overlap->subdivide_approached(y);
    rounds += !indices.empty();
    // The new points are at these indices, and the others keep their order.
    std::vector<InteriorPoint> others = overlap.overlap->interior_points();
    for (size_t i = indices.size(); i > 0; --i) others.erase(others.begin() + indices[i - 1]);
    REQUIRE(others.size() == known.size());
    for (size_t i = 0; i < known.size(); ++i) CHECK(others[i].inside == known[i].inside);
    // No triangle of the overlap that is within range is still deferred.
    std::set<int> subdivided;
    for (const InteriorPoint& s : overlap.overlap->interior_points()) subdivided.insert(s.triangle);
    for (const InteriorPoint& s : all.overlap->interior_points()) {
      if (subdivided.count(s.triangle)) continue;
      const auto& mesh = overlap.at->surface.mesh;
      for (size_t t = 0; t < mesh.triangles.size(); ++t)
        if (mesh.vertex_object[mesh.triangles[t][0]] == 1) CHECK(triangles_apart(corners(y, mesh.triangles[s.triangle]), corners(y, mesh.triangles[t]), range) >= range * (1 - 1e-6));
    }
  }
  CHECK(rounds > 1);
  overlap.overlap->subdivide_approached(overlap.shifted({0, 0, -1.4 * range}));
  REQUIRE(overlap.overlap->interior_points().size() == all.overlap->interior_points().size());
  for (size_t i = 0; i < all.overlap->interior_points().size(); ++i) {
    CHECK(overlap.overlap->interior_points()[i].triangle == all.overlap->interior_points()[i].triangle);
    CHECK(overlap.overlap->interior_points()[i].inside == all.overlap->interior_points()[i].inside);
    CHECK(overlap.overlap->interior_points()[i].area == all.overlap->interior_points()[i].area);
  }
}

TEST_CASE("area of unknown overlap is that of triangles beyond twice the range", "[contact][overlap]") {
  const Overlap near(Setup{.corner = {0, 0, 0.5 * range}}), far(Setup{.corner = {0, 0, 2.5 * range}});
  for (int v = 0; v < 25; ++v) {
    CHECK(near.overlap->unknown_area(v, 1, Vec3::UnitZ()) == 0);
    CHECK(far.overlap->unknown_area(v, 1, Vec3::UnitZ()) == Approx(far.at->lagged.tributary_area(v)));
    CHECK(far.overlap->unknown_area(v, 1, -Vec3::UnitZ()) == 0);
  }
}
