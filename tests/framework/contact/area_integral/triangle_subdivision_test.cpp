// Subdivision of a partly overlapping triangle: its interior points have the area, the centroid and the
// derivative of the exact overlap, which is a polygon in the plane of the opposite surface.
#include "framework/contact/area_integral/triangle_subdivision.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "geometry/distance/triangle_triangle.hpp"
#include "tests/framework/contact/surface_builder.hpp"

using namespace tack;

namespace {

using Corners3 = std::array<Vec3, 3>;

// A convex polygon in the plane, cut at a line where along.p <= limit.
using Polygon2 = std::vector<Vec2>;
Polygon2 cut(const Polygon2& polygon, const Vec2& along, double limit) {
  Polygon2 kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double a = along.dot(p) - limit, b = along.dot(q) - limit;
    if (a <= 0) kept.push_back(p);
    if ((a < 0) != (b < 0) && a != b) kept.push_back(p + a / (a - b) * (q - p));
  }
  return kept;
}
double area_of(const Polygon2& p) {
  double twice = 0;
  for (size_t i = 1; i + 1 < p.size(); ++i) twice += (p[i] - p[0]).x() * (p[i + 1] - p[0]).y() - (p[i] - p[0]).y() * (p[i + 1] - p[0]).x();
  return std::abs(twice) / 2;
}
// The area that the projection of a triangle onto z = 0 has in common with a rectangle from lo to hi.
double common_area(const Corners3& c, const Vec2& lo, const Vec2& hi) {
  Polygon2 p = {c[0].head<2>(), c[1].head<2>(), c[2].head<2>()};
  for (int i = 0; i < 2; ++i) {
    p = cut(p, Vec2::Unit(i), hi[i]);
    p = cut(p, -Vec2::Unit(i), -lo[i]);
  }
  return area_of(p);
}
double whole_area(const Corners3& c) { return (c[1] - c[0]).cross(c[2] - c[0]).norm() / 2; }

// The overlap of a triangle with object 1.
struct Subdivision {
  std::vector<InteriorPoint> points;
  OverlapFacets facets{};
  std::vector<TriangleSubdivision::SkippedCell> skipped;

  double area() const {
    double sum = 0;
    for (const InteriorPoint& s : points) sum += s.area;
    return sum;
  }
  double facet_area() const {
    double sum = 0;
    for (const OverlapFacet& f : facets.facets) sum += f.area;
    return sum;
  }
};

// Triangle 0 above the other triangles, which are object 1. All of these are faced.
struct Scene {
  SurfaceBuilder builder;
  explicit Scene(const Corners3& own, bool sheet = false) { builder.add_triangle(own[0], own[1], own[2], 0, sheet); }
  Scene& rectangle(std::array<int, 2> cells, const Vec3& corner, double width, double depth) {
    builder.add_rectangle(cells, 1, corner, width, depth);
    return *this;
  }
  std::vector<int> others() const {
    std::vector<int> list(builder.two_sided.size() - 1);
    std::iota(list.begin(), list.end(), 1);
    return list;
  }
  Subdivision subdivide(double range, int depth, bool skip = false) const { return subdivide(SurfaceAt(builder), range, depth, skip); }
  Subdivision subdivide(const SurfaceAt& s, double range, int depth, bool skip = false) const {
    TriangleSubdivision subdivision(s.surface.mesh, s.lagged);
    Subdivision d;
    const std::vector<int> nearby = skip ? others() : std::vector<int>();
    subdivision.subdivide({0, 1, range, depth}, others(), nullptr, nearby, d.points, d.facets, d.skipped);
    return d;
  }
};

// A triangle that faces down, tilted a little, around a point.
Corners3 random_triangle(RandomPoints& random, const Vec3& centre, double tilt) {
  for (;;) {
    Corners3 c;
    for (Vec3& p : c) p = centre + random.point(0.6).cwiseProduct(Vec3(1, 1, 0));
    if ((c[1] - c[0]).cross(c[2] - c[0]).z() > 0) std::swap(c[0], c[1]);
    // No slivers: their patches are those of larger triangles.
    const double longest = std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
    if (whole_area(c) < 0.25 * longest * longest) continue;
    const Mat3 r = Eigen::AngleAxisd(random.uniform(-tilt, tilt), Vec3(random.direction().cwiseProduct(Vec3(1, 1, 0)).normalized())).toRotationMatrix();
    for (Vec3& p : c) p = centre + r * (p - centre);
    return c;
  }
}

const Corners3 right_triangle = {Vec3(0, 0, 0.1), Vec3(0, 1, 0.1), Vec3(1, 0, 0.1)};  // faces down

}  // namespace

TEST_CASE("a triangle that overlaps as a whole has its area and centroid, one interior point a cell", "[contact][subdivision]") {
  for (const int depth : {1, 2, 4}) {
    const Subdivision d = Scene(right_triangle).rectangle({3, 3}, {-1, -1, 0}, 3, 3).subdivide(0.2, depth);
    REQUIRE(d.points.size() == static_cast<size_t>(1 << 2 * depth));
    CHECK(d.area() == Approx(0.5).epsilon(1e-12));
    CHECK(d.facet_area() == Approx(0.5).epsilon(1e-12));
    Vec3 centroid = Vec3::Zero();
    std::set<int> cells;
    for (const InteriorPoint& s : d.points) {
      centroid += s.area / 0.5 * s.inside;
      cells.insert(s.cell);
      CHECK(s.area == Approx(0.5 / (1 << 2 * depth)).epsilon(1e-12));
      CHECK((s.normal - Vec3::UnitZ()).norm() < 1e-12);
      CHECK(s.object == 1);
    }
    CHECK((centroid - Vec3::Constant(1 / 3.0)).norm() < 1e-12);
    CHECK(cells.size() == d.points.size());
    CHECK(d.facets.boundary_edges.empty());
    for (const OverlapFacet& f : d.facets.facets) CHECK(f.distance == Approx(0.1));
  }
}

TEST_CASE("a triangle over the end of a surface has the area of the closed form", "[contact][subdivision]") {
  // Left of x = c lies 1/2 - (1 - c)^2 / 2 of the right triangle.
  for (const double c : {0.01, 0.25, 0.5, 0.77, 0.999}) {
    const Subdivision d = Scene(right_triangle).rectangle({2, 3}, {c - 3, -1, 0}, 3, 3).subdivide(0.2, 2);
    INFO(c);
    CHECK(d.area() == Approx(0.5 - (1 - c) * (1 - c) / 2).epsilon(1e-6));
    CHECK(d.facet_area() == Approx(d.area()).epsilon(1e-12));
    for (const InteriorPoint& s : d.points) CHECK(point_inside(SurfaceAt(Scene(right_triangle).builder).lagged.x(), {0, 1, 2}, s.inside).x() <= c + 1e-9);
  }
}

TEST_CASE("overlaps of random triangles with a rectangle are those of their projections, whatever its mesh", "[contact][subdivision]") {
  RandomPoints random(1);
  int partly = 0;
  for (int trial = 0; trial < 25; ++trial) {
    const Corners3 own = random_triangle(random, Vec3(0.5, 0.5, 0.4) + random.point(0.5).cwiseProduct(Vec3(1, 1, 0)), 0.4);
    const double exact = common_area(own, {0, 0}, {1, 1});
    partly += exact > 1e-3 && exact < 0.95 * whole_area(own);
    for (const std::array<int, 2> cells : {std::array{1, 1}, std::array{3, 4}}) {
      const Subdivision d = Scene(own).rectangle(cells, {0, 0, 0}, 1, 1).subdivide(0.6, 2);
      INFO(trial << " " << cells[0]);
      CHECK(d.area() == Approx(exact).margin(1e-6));
      CHECK(d.facet_area() == Approx(d.area()).margin(1e-12));
    }
  }
  CHECK(partly > 10);
}

TEST_CASE("overlaps with two surfaces that meet in a line add up to that with both as one", "[contact][subdivision]") {
  RandomPoints random(2);
  for (int trial = 0; trial < 30; ++trial) {
    const Corners3 own = random_triangle(random, {0.5, 0.5, 0.4}, 0.3);
    const double c = random.uniform(0.2, 0.8);
    const double left = Scene(own).rectangle({1, 1}, {0, 0, 0}, c, 1).subdivide(0.6, 2).area(), right = Scene(own).rectangle({1, 1}, {c, 0, 0}, 1 - c, 1).subdivide(0.6, 2).area();
    CHECK(left + right == Approx(Scene(own).rectangle({1, 1}, {0, 0, 0}, 1, 1).subdivide(0.6, 2).area()).margin(1e-6));
  }
}

TEST_CASE("the overlap does not depend on depth, rotation, translation, or the rotation of corners", "[contact][subdivision]") {
  RandomPoints random(3);
  for (int trial = 0; trial < 6; ++trial) {
    Corners3 own = random_triangle(random, {0.8, 0.7, 0.4}, 0.3);
    const auto scene = [&] { return Scene(own).rectangle({2, 2}, {0, 0, 0}, 1, 1); };
    const double area = scene().subdivide(0.6, 2).area();
    CHECK(scene().subdivide(0.6, 4).area() == Approx(area).margin(1e-6));
    const SurfaceAt turned(scene().builder, moved(scene().builder.x(), random.rotation(), random.point(2)));
    CHECK(scene().subdivide(turned, 0.6, 2).area() == Approx(area).margin(1e-6));
    std::rotate(own.begin(), own.begin() + 1, own.end());
    CHECK(scene().subdivide(0.6, 2).area() == Approx(area).margin(1e-6));
  }
}

TEST_CASE("the derivative of the overlap by a shift is the length of its boundary across the shift", "[contact][subdivision]") {
  RandomPoints random(4);
  for (int trial = 0; trial < 15; ++trial) {
    const Corners3 own = random_triangle(random, {0.9, 0.8, 0.4}, 0.3);
    const Vec3 shift = random.direction().cwiseProduct(Vec3(1, 1, 0));
    const auto at = [&](double s) { return Scene(own).rectangle({2, 2}, s * shift, 1, 1); };
    const Scene scene = at(0);
    const SurfaceAt surface(scene.builder);
    const Subdivision d = scene.subdivide(surface, 0.6, 2);
    double rate = 0;
    for (const OverlapBoundaryEdge& e : d.facets.boundary_edges) {
      const Triangle& t = surface.surface.mesh.triangles[e.other];
      const Vec3 along = vertex(surface.lagged.x(), t[(e.side + 1) % 3]) - vertex(surface.lagged.x(), t[e.side]);
      rate += e.length * along.cross(surface.lagged.normal(e.other)).normalized().dot(shift);
    }
    const double step = 1e-4;
    const auto exact = [&](double s) { return common_area(own, s * shift.head<2>(), s * shift.head<2>() + Vec2(1, 1)); };
    INFO(trial);
    CHECK(rate == Approx((exact(step) - exact(-step)) / (2 * step)).margin(2e-3));
  }
}

TEST_CASE("the overlap with an L is that of its squares but for one cell at its inner corner", "[contact][subdivision]") {
  RandomPoints random(6);
  int within = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Corners3 own = random_triangle(random, {0.55, 0.5, 0.4}, 0.3);
    Scene scene(own);
    std::array<int, 8> v{};
    for (int i = 0; i < 8; ++i) v[i] = scene.builder.add_vertex({0.5 * (i % 3), 0.5 * (i / 3), 0}, 1);
    for (const int corner : {0, 1, 3}) {  // of three quarters of the unit square
      scene.builder.add_triangle({v[corner], v[corner + 1], v[corner + 4]});
      scene.builder.add_triangle({v[corner], v[corner + 4], v[corner + 3]});
    }
    // A cell whose corners overlap counts as a whole, although the inner corner may lie within it.
    const Subdivision d = scene.subdivide(0.6, 4);
    const double cell = whole_area(own) / 256;
    CHECK(d.area() == Approx(common_area(own, {0, 0}, {1, 1}) - common_area(own, {0.5, 0.5}, {1, 1})).margin(cell));
    // A line that goes on beyond the corner lies within the overlap, where its segments come in pairs that cancel.
    for (const OverlapBoundaryEdge& e : d.facets.boundary_edges) {
      if (e.length > 0) continue;
      ++within;
      CHECK(std::count_if(d.facets.boundary_edges.begin(), d.facets.boundary_edges.end(), [&](const OverlapBoundaryEdge& other) {
        return other.other == e.other && other.side == e.side && (other.inside - e.inside).norm() < 1e-9 && std::abs(other.length + e.length) < 1e-9;
      }) == 1);
    }
  }
  CHECK(within > 0);
}

TEST_CASE("only surfaces nearer than twice the range overlap", "[contact][subdivision]") {
  for (const double range : {0.049, 0.051}) {
    const Subdivision d = Scene(right_triangle).rectangle({1, 1}, {-1, -1, 0}, 3, 3).subdivide(range, 2);
    CHECK(d.area() == Approx(range < 0.05 ? 0 : 0.5));
  }
}

TEST_CASE("a triangle that faces away has no overlap, unless it is of a sheet", "[contact][subdivision]") {
  const Corners3 up = {right_triangle[0], right_triangle[2], right_triangle[1]};
  for (const bool sheet : {false, true}) CHECK(Scene(up, sheet).rectangle({1, 1}, {-1, -1, 0}, 3, 3).subdivide(0.2, 2).area() == Approx(sheet ? 0.5 : 0));
}

TEST_CASE("skipped cells are out of range, and subdivided later they complete the overlap", "[contact][subdivision]") {
  RandomPoints random(5);
  size_t skipped = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const double range = 0.25;
    const Scene scene = Scene(random_triangle(random, {0.8, 0.7, 0.3}, 0.6)).rectangle({2, 2}, {0, 0, 0}, 1, 1);
    const SurfaceAt s(scene.builder);
    const Subdivision all = scene.subdivide(s, range, 3);
    Subdivision d = scene.subdivide(s, range, 3, true);
    CHECK(all.skipped.empty());
    CHECK(d.area() <= all.area() * (1 + 1e-12));
    skipped += d.skipped.size();
    TriangleSubdivision subdivision(s.surface.mesh, s.lagged);
    for (const auto& [cell, excess] : d.skipped) {
      CHECK(excess > 0);
      const size_t before = d.points.size();
      subdivision.subdivide_cell({0, 1, range, 3}, cell, scene.others(), nullptr, d.points, d.facets);
      CHECK(d.points.size() <= before + 1);
      // An interior point of a cell is out of range by as much as the cell at least.
      for (size_t i = before; i < d.points.size(); ++i) {
        CHECK(d.points[i].cell == cell);
        const Vec3 p = point_inside(s.lagged.x(), s.surface.mesh.triangles[0], d.points[i].inside);
        double nearest = 1;
        for (const int t : scene.others()) nearest = std::min(nearest, triangles_apart({p, p, p}, corners(s.lagged.x(), s.surface.mesh.triangles[t]), 1));
        CHECK(nearest >= (range + excess) * (1 - 1e-6));
      }
    }
    REQUIRE(d.points.size() == all.points.size());
    std::sort(d.points.begin(), d.points.end(), [](const InteriorPoint& a, const InteriorPoint& b) { return a.cell < b.cell; });
    for (size_t i = 0; i < all.points.size(); ++i) {
      CHECK(d.points[i].cell == all.points[i].cell);
      CHECK(d.points[i].area == Approx(all.points[i].area).epsilon(1e-9));
      CHECK((d.points[i].inside - all.points[i].inside).norm() < 1e-9);
    }
  }
  CHECK(skipped > 20);
}

TEST_CASE("the depth of cells is the least, from one on, at which they have at most the size", "[contact][subdivision]") {
  for (const double area : {0.5, 2.0, 1e-6})
    for (const double ratio : {0.03, 0.11, 0.3, 0.7}) {
      const double side = std::sqrt(2 * area), size = ratio * side;
      const int depth = TriangleSubdivision::depth_of(area, size);
      CHECK(side / (1 << depth) <= size * (1 + 1e-12));
      if (depth > 1) CHECK(side / (1 << (depth - 1)) > size);
    }
  CHECK(TriangleSubdivision::depth_of(1, 100) == 1);
}

TEST_CASE("pins the largest depth of cells", "[contact][subdivision]") { CHECK(TriangleSubdivision::depth_of(1, 1e-9) == 6); }
