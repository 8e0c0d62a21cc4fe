// Clipping of a triangle by boundary lines: the polygons divide the triangle, each lies on one side
// of every line, and their areas are those of the closed forms.
#include "framework/contact/area_integral/polygon_clip.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>

#include "tests/framework/contact/surface_builder.hpp"

using namespace tack;

namespace {

const std::array<Vec3, 3> whole_triangle = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
const Triangle own = {0, 1, 2};

VecX positions(const Vec3& a, const Vec3& b, const Vec3& c) {
  VecX x(9);
  x << a, b, c;
  return x;
}

const VecX unit_right = positions({0, 0, 0}, {1, 0, 0}, {0, 1, 0});

double area_of(const VecX& x, const ClipPolygon& polygon) {
  const Vec3 first = point_inside(x, own, polygon[0].inside);
  Vec3 twice = Vec3::Zero();
  for (size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += (point_inside(x, own, polygon[i].inside) - first).cross(point_inside(x, own, polygon[i + 1].inside) - first);
  return twice.norm() / 2;
}

double area_of(const VecX& x, const std::vector<ClipPolygon>& polygons) {
  double sum = 0;
  for (const ClipPolygon& p : polygons) sum += area_of(x, p);
  return sum;
}

Vec3 centre_of(const VecX& x, const ClipPolygon& polygon) {
  Vec3 sum = Vec3::Zero();
  for (const ClipCorner& c : polygon) sum += point_inside(x, own, c.inside);
  return sum / static_cast<double>(polygon.size());
}

ClipLine line(const Vec3& at, const Vec3& outward) { return {0, 0, at, outward.normalized()}; }

// The area of the polygons on the inner side of a line.
double inner_area(const VecX& x, const std::vector<ClipPolygon>& polygons, const ClipLine& l) {
  double sum = 0;
  for (const ClipPolygon& p : polygons)
    if ((centre_of(x, p) - l.at).dot(l.outward) < 0) sum += area_of(x, p);
  return sum;
}

// A horizontal square of two triangles, which are one smooth face with four boundary edges.
SurfaceBuilder square() {
  SurfaceBuilder s;
  s.add_rectangle({1, 1}, 0, {0, 0, 0}, 1, 1);
  return s;
}

std::vector<ClipLine> lines_at(const SurfaceAt& s, int triangle, const Vec3& p) {
  std::vector<ClipLine> lines;
  add_clip_lines(s.surface.mesh, s.lagged, nullptr, triangle, p, lines);
  return lines;
}

}  // namespace

TEST_CASE("a polygon clip without lines returns the subtriangle itself", "[contact][clip]") {
  const auto polygons = clip_by_lines(unit_right, own, whole_triangle, {});
  REQUIRE(polygons.size() == 1);
  REQUIRE(polygons[0].size() == 3);
  for (int i = 0; i < 3; ++i) {
    CHECK(polygons[0][i].inside == whole_triangle[i]);
    CHECK(polygons[0][i].line == -1);
    CHECK_FALSE(polygons[0][i].outside);
  }
}

TEST_CASE("a line cuts a right triangle into the areas of the closed form", "[contact][clip]") {
  // Left of x = c lies 1/2 - (1 - c)^2 / 2 of the triangle (0, 0), (1, 0), (0, 1).
  for (const double c : {1e-6, 0.1, 0.5, 0.9, 1 - 1e-6}) {
    const ClipLine cut = line({c, 0.3, 5}, {1, 0, 0});
    const auto polygons = clip_by_lines(unit_right, own, whole_triangle, {cut});
    REQUIRE(polygons.size() == 2);
    CHECK(inner_area(unit_right, polygons, cut) == Approx(0.5 - (1 - c) * (1 - c) / 2).epsilon(1e-9));
    CHECK(area_of(unit_right, polygons) == Approx(0.5).epsilon(1e-12));
  }
}

TEST_CASE("a line that misses the triangle, or only touches it, leaves it whole", "[contact][clip]") {
  for (const ClipLine& cut : {line({2, 0, 0}, {1, 0, 0}), line({-1, 0, 0}, {1, 0, 0}), line({1, 0, 0}, {1, 0, 0}), line({0, 0, 0}, {-1, 0, 0}),
                              line({0, 0, 0}, {0, -1, 0}), line({1, 0, 0}, {1, 1, 0}), line({0, 1, 0}, {0, 1, 0})}) {
    const auto polygons = clip_by_lines(unit_right, own, whole_triangle, {cut});
    double largest = 0;
    for (const ClipPolygon& p : polygons) largest = std::max(largest, area_of(unit_right, p));
    CHECK(largest == Approx(0.5).epsilon(1e-12));
    CHECK(area_of(unit_right, polygons) == Approx(0.5).epsilon(1e-12));
  }
}

TEST_CASE("polygons of random lines divide any subtriangle, and each lies on one side of every line", "[contact][clip]") {
  RandomPoints random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const VecX x = positions(random.point(1), random.point(1), random.point(1));
    const std::array<Vec3, 3> piece = {random.inside(), random.inside(), random.inside()};
    std::vector<ClipLine> lines;
    for (int k = random.index(5); k >= 0; --k) lines.push_back(line(point_inside(x, own, random.inside()), random.direction()));
    const auto polygons = clip_by_lines(x, own, piece, lines);
    const double all = area_of(x, ClipPolygon{{piece[0], -1, false}, {piece[1], -1, false}, {piece[2], -1, false}});
    CHECK(area_of(x, polygons) == Approx(all).epsilon(1e-9).margin(1e-12));
    for (const ClipPolygon& p : polygons) {
      CHECK(p.size() <= 3 + lines.size());
      for (const ClipLine& l : lines) {
        double low = 0, high = 0;
        for (const ClipCorner& c : p) {
          const double height = (point_inside(x, own, c.inside) - l.at).dot(l.outward);
          low = std::min(low, height);
          high = std::max(high, height);
        }
        CHECK(std::min(-low, high) < 1e-12);
      }
      for (const ClipCorner& c : p) CHECK(c.inside.sum() == Approx(1).epsilon(1e-12));
    }
  }
}

TEST_CASE("edges of polygons along a line carry its index and the side of the polygon", "[contact][clip]") {
  RandomPoints random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const VecX x = positions(random.point(1), random.point(1), random.point(1));
    std::vector<ClipLine> lines;
    for (int k = 0; k < 3; ++k) lines.push_back(line(point_inside(x, own, random.inside()), random.direction()));
    std::vector<double> balance(lines.size(), 0);  // length of inner edges less that of outer ones
    for (const ClipPolygon& p : clip_by_lines(x, own, whole_triangle, lines)) {
      const Vec3 centre = centre_of(x, p);
      for (size_t i = 0; i < p.size(); ++i) {
        const Vec3 a = point_inside(x, own, p[i].inside), b = point_inside(x, own, p[(i + 1) % p.size()].inside);
        if (p[i].line < 0) continue;
        const ClipLine& l = lines[p[i].line];
        CHECK(std::abs((a - l.at).dot(l.outward)) < 1e-12);
        CHECK(std::abs((b - l.at).dot(l.outward)) < 1e-12);
        if (const double height = (centre - l.at).dot(l.outward); std::abs(height) > 1e-9) CHECK(p[i].outside == (height > 0));
        balance[p[i].line] += (p[i].outside ? -1 : 1) * (b - a).norm();
      }
    }
    // Every segment of a line bounds one polygon on each side, so that no facet of the overlap gains what another does not lose.
    for (const double b : balance) CHECK(std::abs(b) < 1e-9);
  }
}

TEST_CASE("a polygon clip does not depend on rotation, translation, or the order of lines", "[contact][clip]") {
  RandomPoints random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const VecX x = positions(random.point(1), random.point(1), random.point(1));
    const Mat3 r = random.rotation();
    const Vec3 offset = random.point(3);
    std::vector<ClipLine> lines, turned;
    for (int k = 0; k < 3; ++k) {
      lines.push_back(line(point_inside(x, own, random.inside()), random.direction()));
      turned.push_back({0, 0, r * lines.back().at + offset, r * lines.back().outward});
    }
    std::reverse(turned.begin(), turned.end());
    const auto areas = [&](const VecX& at, const std::vector<ClipLine>& by) {
      std::vector<double> sorted;
      for (const ClipPolygon& p : clip_by_lines(at, own, whole_triangle, by))
        if (const double area = area_of(at, p); area > 1e-9) sorted.push_back(area);
      std::sort(sorted.begin(), sorted.end());
      return sorted;
    };
    const auto before = areas(x, lines), after = areas(moved(x, r, offset), turned);
    REQUIRE(before.size() == after.size());
    for (size_t i = 0; i < before.size(); ++i) CHECK(before[i] == Approx(after[i]).margin(1e-10));
  }
}

TEST_CASE("reversing a line swaps the inner and the outer area", "[contact][clip]") {
  RandomPoints random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const ClipLine cut = line(point_inside(unit_right, own, random.inside()), random.direction());
    const ClipLine reversed{0, 0, cut.at, -cut.outward};
    const double inner = inner_area(unit_right, clip_by_lines(unit_right, own, whole_triangle, {cut}), cut);
    const double outer = inner_area(unit_right, clip_by_lines(unit_right, own, whole_triangle, {reversed}), reversed);
    CHECK(inner + outer == Approx(0.5).epsilon(1e-9));
  }
}

TEST_CASE("a point above a face has no clip lines, one beside a boundary edge has that edge", "[contact][clip]") {
  const SurfaceAt s(square());
  for (int t = 0; t < 2; ++t) {
    const auto c = corners(s.surface.rest, s.surface.mesh.triangles[t]);
    CHECK(lines_at(s, t, (c[0] + c[1] + c[2]) / 3 + Vec3(0, 0, 0.2)).empty());
    for (int side = 0; side < 3; ++side) {
      const Vec3 middle = (c[side] + c[(side + 1) % 3]) / 2, out = middle - Vec3(0.5, 0.5, 0);
      const auto lines = lines_at(s, t, middle + 0.1 * (out.norm() > 0.1 ? out : Vec3(middle - c[(side + 2) % 3])) + Vec3(0, 0, 0.2));
      if (out.norm() < 0.1) {
        CHECK(lines.empty());  // the diagonal, beyond which the square goes on
        continue;
      }
      REQUIRE(lines.size() == 1);
      CHECK(lines[0].outward.dot(out.normalized()) == Approx(1));
      CHECK(std::abs((middle - lines[0].at).dot(lines[0].outward)) < 1e-12);
      CHECK(lines[0].triangle == t);
      CHECK(lines[0].side == side);
    }
  }
}

TEST_CASE("a point beside a corner of a square has both of its boundary lines, each once", "[contact][clip]") {
  const SurfaceAt s(square());
  for (const Vec3& at : {Vec3(-0.1, -0.2, 0.3), Vec3(1.1, -0.1, 0.1), Vec3(1.3, 1.1, 0.2), Vec3(-0.2, 1.1, 0.1)})
    for (int t = 0; t < 2; ++t) {
      const Triangle& v = s.surface.mesh.triangles[t];
      const Vec3 nearest(at.x() < 0.5 ? 0 : 1, at.y() < 0.5 ? 0 : 1, 0);
      if (std::none_of(v.begin(), v.end(), [&](int i) { return Vec3(vertex(s.surface.rest, i)) == nearest; })) continue;
      auto lines = lines_at(s, t, at);
      REQUIRE(lines.size() == 2);
      CHECK(std::abs(lines[0].outward.dot(lines[1].outward)) < 1e-12);
      for (const ClipLine& l : lines) CHECK((at - l.at).dot(l.outward) > 0);
      add_clip_lines(s.surface.mesh, s.lagged, nullptr, t, at, lines);
      CHECK(lines.size() == 2);
    }
}

TEST_CASE("collinear boundary edges of a fine mesh are one clip line", "[contact][clip]") {
  SurfaceBuilder builder;
  builder.add_rectangle({4, 4}, 0, {0, 0, 0}, 1, 1);
  const SurfaceAt s(builder);
  std::vector<ClipLine> lines;
  for (int t = 0; t < static_cast<int>(s.surface.mesh.triangles.size()); ++t) {
    const auto c = corners(s.surface.rest, s.surface.mesh.triangles[t]);
    if (std::min({c[0].y(), c[1].y(), c[2].y()}) > 0) continue;
    for (const double x : {0.3, 0.4, 0.6}) add_clip_lines(s.surface.mesh, s.lagged, nullptr, t, {x, -0.1, 0.1}, lines);
  }
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].outward.dot(Vec3(0, -1, 0)) == Approx(1));
}
