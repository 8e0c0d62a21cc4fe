// Overlap areas of rods: closed forms of crossing and parallel rods, which no mesh changes.
#include "framework/contact/area_integral/rod_overlaps.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/framework/contact/surface_builder.hpp"

using namespace tack;

namespace {

constexpr double range = 0.05;  // m

using Segment = std::array<Vec3, 2>;

// Two rods as objects 0 and 1, and their overlaps.
struct Rods {
  Rods(const Segment& a, int edges_a, double width_a, const Segment& b, int edges_b, double width_b) {
    add(a, edges_a, 0, width_a);
    add(b, edges_b, 1, width_b);
    const SurfaceAt s(builder);
    PairTable pairs(2);
    PairRole role;
    role.law = 0;
    role.range = range;
    pairs.set_codimensional(0, 1, role);
    Candidates candidates;
    for (int e = 0; e < edges_a; ++e)
      for (int f = 0; f < edges_b; ++f) candidates.edge_edge.push_back({e, edges_a + f});
    RodOverlaps overlaps(s.surface, pairs);
    overlaps.find(candidates, s.lagged);
    for (const auto& c : overlaps.crossings()) crossing += c.area, ++crossings;
    for (int v = 0; v <= edges_a; ++v) first += overlaps.area(v, 1);
    for (int v = edges_a + 1; v <= edges_a + edges_b + 1; ++v) second += overlaps.area(v, 0);
  }
  void add(const Segment& s, int edges, int object, double width) {
    std::vector<Vec3> points;
    for (int i = 0; i <= edges; ++i) points.push_back(s[0] + double(i) / edges * (s[1] - s[0]));
    builder.add_rod(points, object, width);
  }

  SurfaceBuilder builder;
  int crossings = 0;
  double crossing = 0, first = 0, second = 0;  // m^2
};

// Returns a segment at a height, of a length, turned by an angle about its centre.
Segment flat(double length, double angle, double height, const Vec3& centre = Vec3::Zero()) {
  const Vec3 half = length / 2 * Vec3(std::cos(angle), std::sin(angle), 0), at = centre + Vec3(0, 0, height);
  return {Vec3(at - half), Vec3(at + half)};
}

double shadow(const Segment& a, double wa, const Segment& b, double wb, const Vec3& n) {
  Vec3 centre;
  return projected_overlap(a, wa, b, wb, n, centre);
}

}  // namespace

TEST_CASE("the projections of crossing edges have the parallelogram in common, centred at the crossing", "[contact][rods]") {
  for (const double degrees : {20.0, 45.0, 90.0, 135.0}) {
    const double angle = degrees / 180 * M_PI;
    Vec3 centre;
    const double area = projected_overlap(flat(2, 0, 0), 0.01, flat(2, angle, 0.1, {0.2, 0, 0}), 0.02, Vec3::UnitZ(), centre);
    CHECK(area == Approx(0.01 * 0.02 / std::sin(angle)));
    CHECK(centre.x() == Approx(0.2));
    CHECK(std::abs(centre.y()) < 1e-12);
  }
}

TEST_CASE("the projections of parallel edges have the common length times the common width in common", "[contact][rods]") {
  const Vec3 z = Vec3::UnitZ();
  CHECK(shadow(flat(2, 0, 0), 0.01, flat(1, 0, 0.1, {0.7, 0, 0}), 0.02, z) == Approx(0.8 * 0.01));
  CHECK(shadow(flat(2, 0, 0), 0.1, flat(2, 0, 0.1, {0, 0.06, 0}), 0.1, z) == Approx(2 * 0.04));
  CHECK(shadow(flat(2, 0, 0), 0.1, flat(2, M_PI, 0.1), 0.1, z) == Approx(2 * 0.1));
  // They touch, or lie apart.
  CHECK(shadow(flat(2, 0, 0), 0.1, flat(2, 0, 0.1, {0, 0.1, 0}), 0.1, z) == Approx(0).margin(1e-12));
  CHECK(shadow(flat(2, 0, 0), 0.1, flat(2, 0, 0.1, {2, 0, 0}), 0.1, z) == Approx(0).margin(1e-12));
  CHECK(shadow(flat(2, 0, 0), 0.1, flat(2, 0, 0.1, {0, 5, 0}), 0.1, z) == 0);
}

TEST_CASE("the common area is symmetric, and independent of direction, rotation and translation", "[contact][rods]") {
  RandomPoints random(1);
  int some = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Segment a = {random.point(1), random.point(1)}, b = {random.point(1), random.point(1)};
    const double wa = random.uniform(0.1, 0.5), wb = random.uniform(0.1, 0.5);
    const Vec3 n = random.direction(), offset = random.point(3);
    const Mat3 r = random.rotation();
    const auto turned = [&](const Segment& s) { return Segment{Vec3(r * s[0] + offset), Vec3(r * s[1] + offset)}; };
    const double area = shadow(a, wa, b, wb, n);
    some += area > 0;
    CHECK(shadow(b, wb, a, wa, n) == Approx(area).margin(1e-12));
    CHECK(shadow({a[1], a[0]}, wa, b, wb, n) == Approx(area).margin(1e-12));
    CHECK(shadow(a, wa, b, wb, -n) == Approx(area).margin(1e-12));
    CHECK(shadow(turned(a), wa, turned(b), wb, r * n) == Approx(area).margin(1e-9));
    // Moving an edge along the projection changes nothing.
    CHECK(shadow(a, wa, {Vec3(b[0] + 0.7 * n), Vec3(b[1] + 0.7 * n)}, wb, n) == Approx(area).margin(1e-9));
    // The areas of two halves add up to that of the edge.
    const Vec3 middle = 0.3 * a[0] + 0.7 * a[1];
    CHECK(shadow({a[0], middle}, wa, b, wb, n) + shadow({middle, a[1]}, wa, b, wb, n) == Approx(area).margin(1e-9));
  }
  CHECK(some > 50);
}

TEST_CASE("the common area of random edges is that of points by brute force", "[contact][rods]") {
  RandomPoints random(2);
  const auto in_shadow = [](const Vec3& p, const Segment& s, double width, const Vec3& n) {
    const auto flatten = [&](const Vec3& q) { return Vec3(q - n.dot(q) * n); };
    const Vec3 along = flatten(s[1] - s[0]), from = flatten(p - s[0]);
    const double u = from.dot(along) / along.squaredNorm();
    return u >= 0 && u <= 1 && (from - u * along).norm() <= width / 2;
  };
  for (int trial = 0; trial < 4; ++trial) {
    const Vec3 n = random.direction(), x = n.unitOrthogonal(), y = n.cross(x);
    const Segment a = {Vec3(-0.5 * x), Vec3(0.6 * x + 0.1 * y)}, b = {Vec3(random.point(0.5)), Vec3(random.point(0.8))};
    constexpr int k = 400;
    int inside = 0;
    for (int i = 0; i < k * k; ++i) {
      const Vec3 p = (4.0 * (i % k + 0.5) / k - 2) * x + (4.0 * (i / k + 0.5) / k - 2) * y;
      inside += in_shadow(p, a, 0.6, n) && in_shadow(p, b, 0.5, n);
    }
    CHECK(shadow(a, 0.6, b, 0.5, n) == Approx(16.0 * inside / k / k).margin(3e-3));
  }
}

TEST_CASE("a disc and a strip have a strip in common while it is narrow, and all of the disc once it is wide", "[contact][rods]") {
  CHECK(disc_overlap(0.3, 1e-6) == Approx(2 * 0.3 * 1e-6).epsilon(1e-9));
  CHECK(disc_overlap(0.3, 0.6) == Approx(M_PI * 0.09));
  CHECK(disc_overlap(0.3, 7) == Approx(M_PI * 0.09));
  CHECK(disc_overlap(1, std::sqrt(2)) == Approx(1 + M_PI / 2));  // half the width sqrt(1/2): a square and two segments
  // The derivative by the width is the chord at its boundary.
  for (const double width : {0.1, 0.3, 0.5}) {
    const double h = 1e-6, slope = (disc_overlap(0.3, width + h) - disc_overlap(0.3, width - h)) / (2 * h);
    CHECK(slope == Approx(2 * std::sqrt(0.09 - width * width / 4)).epsilon(1e-6));
  }
}

TEST_CASE("crossing rods carry the parallelogram by one pair of edges, whatever their meshes", "[contact][rods]") {
  for (const double degrees : {10.0, 60.0, 90.0})
    for (const int edges : {1, 3, 8}) {
      const double angle = degrees / 180 * M_PI;
      const Rods rods(flat(1, 0, 0), edges, 0.002, flat(1, angle, 0.004), 2 * edges + 1, 0.003);
      INFO(degrees << " " << edges);
      CHECK(rods.crossings == 1);
      CHECK(rods.crossing == Approx(0.002 * 0.003 / std::sin(angle)));
      CHECK(rods.first == 0);
      CHECK(rods.second == 0);
    }
}

TEST_CASE("parallel rods carry the common length times the smaller width, half by the vertices of each", "[contact][rods]") {
  for (const int edges : {1, 2, 7}) {
    const Rods rods(flat(1, 0, 0), edges, 0.002, flat(1, 0, 0.004, {0.25, 0, 0}), edges + 2, 0.003);
    CHECK(rods.crossings == 0);
    CHECK(rods.first == Approx(0.75 * 0.002 / 2));
    CHECK(rods.second == Approx(0.75 * 0.002 / 2));
  }
}

TEST_CASE("pins the angles between which nearly parallel rods carry the parallelogram by edges and vertices together", "[contact][rods]") {
  for (const double sine : {0.025, 0.031, 0.045, 0.059, 0.07}) {
    const Rods rods(flat(1, 0, 0), 1, 0.002, flat(1, std::asin(sine), 0.004), 1, 0.003);
    INFO(sine);
    CHECK(rods.crossing + rods.first + rods.second == Approx(0.002 * 0.003 / sine));
    CHECK(rods.first == Approx(rods.second));
    CHECK((rods.crossing > 0) == (sine > 0.03));
    CHECK((rods.first > 0) == (sine < 0.06));
  }
}

TEST_CASE("rods beyond twice the range, and rods whose projections do not meet, have no overlap", "[contact][rods]") {
  for (const double height : {2 * range * 1.001, 1.0}) {
    const Rods crossing(flat(1, 0, 0), 2, 0.002, flat(1, 1, height), 2, 0.003), parallel(flat(1, 0, 0), 2, 0.002, flat(1, 0, height), 2, 0.003);
    for (const Rods* rods : {&crossing, &parallel}) CHECK(rods->crossing + rods->first + rods->second == 0);
  }
  CHECK(Rods(flat(1, 0, 0), 2, 0.002, flat(1, 1, 2 * range * 0.999), 2, 0.003).crossing > 0);
}

TEST_CASE("the overlap of rods is equal if the two are exchanged", "[contact][rods]") {
  for (const double angle : {0.0, 0.04, 0.7}) {
    const Rods one(flat(1, 0, 0), 3, 0.002, flat(1, angle, 0.004), 4, 0.003), other(flat(1, angle, 0.004), 4, 0.003, flat(1, 0, 0), 3, 0.002);
    CHECK(one.crossing == Approx(other.crossing));
    CHECK(one.first == Approx(other.second));
    CHECK(one.second == Approx(other.first));
  }
}
