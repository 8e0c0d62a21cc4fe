// Additive CCD against dense sampling of the path in extended precision (no false negatives),
// against closed forms (steps not needlessly small), and on degenerate input.
#include "geometry/ccd/accd.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/point_edge.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "geometry/errors.hpp"
#include "tests/geometry/distance/random_stencils.hpp"

using namespace tack;

namespace {

enum class Kind { point_point, point_edge, point_triangle, edge_edge };
constexpr Kind all_kinds[] = {Kind::point_point, Kind::point_edge, Kind::point_triangle,
                           Kind::edge_edge};

double accd(Kind kind, const Stencil& x, const Stencil& d, double gap_fraction_min, double t_max,
            double min_distance = 0.0) {
  const Vec3 a = x.col(0), b = x.col(1), c = x.col(2), e = x.col(3);
  const Vec3 da = d.col(0), db = d.col(1), dc = d.col(2), de = d.col(3);
  switch (kind) {
    case Kind::point_point:
      return point_point_accd(a, b, da, db, gap_fraction_min, t_max, min_distance);
    case Kind::point_edge:
      return point_edge_accd(a, b, c, da, db, dc, gap_fraction_min, t_max, min_distance);
    case Kind::point_triangle:
      return point_triangle_accd(a, b, c, e, da, db, dc, de, gap_fraction_min, t_max, min_distance);
    default:
      return edge_edge_accd(a, b, c, e, da, db, dc, de, gap_fraction_min, t_max, min_distance);
  }
}

// Distance at time t; positions relative to the first vertex are advanced in extended precision.
double distance_at(Kind kind, const Stencil& x, const Stencil& d, double t) {
  using Extended = Eigen::Matrix<long double, 3, 4>;
  Extended y = x.cast<long double>() + static_cast<long double>(t) * d.cast<long double>();
  const Eigen::Matrix<long double, 3, 1> origin = y.col(0);
  y.colwise() -= origin;
  const Stencil z = y.cast<double>();
  const Vec3 a = z.col(0), b = z.col(1), c = z.col(2), e = z.col(3);
  switch (kind) {
    case Kind::point_point:
      return (a - b).norm();
    case Kind::point_edge:
      return std::sqrt(point_edge_distance(a, b, c));
    case Kind::point_triangle:
      return std::sqrt(point_triangle_distance(a, b, c, e));
    default:
      return std::sqrt(edge_edge_distance(a, b, c, e));
  }
}

double smallest_distance(Kind kind, const Stencil& x, const Stencil& d, double t_end, int samples) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= samples; ++k) {
    smallest = std::min(smallest, distance_at(kind, x, d, t_end * k / samples));
  }
  return smallest;
}

// Checks that the minimum fraction of the gap remains on the path up to the returned step.
double check_safe(Kind kind, const Stencil& x, const Stencil& d, double gap_fraction_min, double t_max,
                  double min_distance = 0.0) {
  const double gap = distance_at(kind, x, d, 0.0) - min_distance;
  const double t = accd(kind, x, d, gap_fraction_min, t_max, min_distance);
  const double left = smallest_distance(kind, x, d, t, 200) - min_distance;
  if (!(t >= 0 && t <= t_max && left >= gap_fraction_min * gap * (1 - 1e-9))) {
    CAPTURE(static_cast<int>(kind), x, d, gap_fraction_min, t_max, min_distance, gap, t, left);
    CHECK(left >= gap_fraction_min * gap * (1 - 1e-9));
    CHECK(t >= 0);
    CHECK(t <= t_max);
  }
  return t;
}

Stencil random_motion(RandomStencils& random, double size) { return size * random.any(); }

}  // namespace

TEST_CASE("ACCD never steps through random motion", "[ccd]") {
  RandomStencils random(31);
  for (const Kind kind : all_kinds) {
    int stopped = 0, free = 0;
    for (int k = 0; k < 1000; ++k) {
      const Stencil x = random.any();
      const Stencil d = random_motion(random, random.log_uniform(1e-2, 30));
      const double gap_fraction_min = random.uniform(0, 0.9);
      const double t = check_safe(kind, x, d, gap_fraction_min, 1.0);
      ++(t < 1.0 ? stopped : free);
      // A step ends near the target: within 5% of the gap.
      const double gap = distance_at(kind, x, d, 0.0);
      if (t < 1.0) CHECK(distance_at(kind, x, d, t) <= (gap_fraction_min + 0.05) * gap);
    }
    CHECK(stopped > 50);
    CHECK(free > 50);
  }
}

TEST_CASE("ACCD is safe and useful for tiny gaps and huge motions", "[ccd]") {
  RandomStencils random(32);
  for (int k = 0; k < 1000; ++k) {
    const double gap = random.log_uniform(1e-9, 1e-2);
    const double height = random.log_uniform(1e-3, 1), angle = random.log_uniform(1e-3, 1);
    const Stencil d = random_motion(random, random.log_uniform(1e-9, 1e6));
    const double speed = 4.0 * d.norm();
    for (const Kind kind : {Kind::point_triangle, Kind::edge_edge}) {
      const Stencil x = kind == Kind::edge_edge ? random.crossing(gap, angle)
                                                : random.above_triangle(gap, height);
      const double t = check_safe(kind, x, d, 0.1, 1.0);
      CHECK(t >= std::min(1.0, 0.8 * gap / speed));
    }
  }
}

TEST_CASE("ACCD stops a head-on approach close to the closed form", "[ccd]") {
  RandomStencils random(33);
  for (const double gap : {1e-9, 1e-6, 1e-3, 1.0}) {
    for (const double gap_fraction_min : {0.0, 0.1, 0.5}) {
      for (const double speed : {0.5, 1.0, 1e6}) {
        Stencil d = Stencil::Zero();
        const Stencil flat = random.above_triangle(gap, 0.7);
        const Vec3 n = point_triangle_separation(flat.col(0), flat.col(1), flat.col(2), flat.col(3))
                           .normalized();
        d.col(0) = -0.3 * speed * n;
        d.rightCols<3>().colwise() = Vec3(0.7 * speed * n);
        const double exact = (1 - gap_fraction_min) * gap / speed;
        const double t = check_safe(Kind::point_triangle, flat, d, gap_fraction_min, 1e9);
        CHECK(t <= exact * (1 + 1e-6));
        CHECK(t >= 0.97 * exact);

        const Stencil cross = random.crossing(gap, 0.9);
        const Vec3 m = edge_edge_separation(cross.col(0), cross.col(1), cross.col(2), cross.col(3))
                           .normalized();
        d.leftCols<2>().colwise() = Vec3(-speed * m);
        d.rightCols<2>().setZero();
        const double u = check_safe(Kind::edge_edge, cross, d, gap_fraction_min, 1e9);
        CHECK(u <= exact * (1 + 1e-6));
        CHECK(u >= 0.97 * exact);
      }
    }
  }
}

TEST_CASE("ACCD keeps a minimum distance", "[ccd]") {
  const Vec3 p(0, 0, 1), q(0, 0, 0), down(0, 0, -1), still(0, 0, 0);
  const double t = point_point_accd(p, q, down, still, 0.0, 2.0, 0.25);
  CHECK(t <= 0.75);
  CHECK(t >= 0.97 * 0.75);
  CHECK(point_point_accd(p, q, down, still, 0.1, 2.0, 1.0) == 0.0);
  RandomStencils random(34);
  for (int k = 0; k < 500; ++k) {
    const Stencil x = random.above_triangle(random.uniform(0.02, 0.1), 0.8);
    check_safe(Kind::point_triangle, x, random_motion(random, 1.0), 0.2, 1.0, 0.015);
  }
}

TEST_CASE("ACCD does not shorten motion that closes no gap", "[ccd]") {
  RandomStencils random(35);
  for (const Kind kind : all_kinds) {
    for (int k = 0; k < 100; ++k) {
      const Stencil x = random.any();
      CHECK(accd(kind, x, Stencil::Zero(), 0.1, 0.7) == 0.7);
      const Stencil carried = random.vector().replicate<1, 4>() * 1e6;
      CHECK(accd(kind, x, carried, 0.1, 1.0) == 1.0);
    }
  }
  // Sliding along the surface, a thousand gaps far; away from it; and a start in contact at rest.
  const Vec3 p(0.3, 0.3, 1e-3), t0(0, 0, 0), t1(1, 0, 0), t2(0, 1, 0), o(0, 0, 0);
  CHECK(point_triangle_accd(p, t0, t1, t2, {5, 2, 0}, o, o, o, 0.1, 1.0) == 1.0);
  CHECK(point_triangle_accd(p, t0, t1, t2, {0, 0, 9}, o, o, o, 0.1, 1.0) == 1.0);
  CHECK(point_triangle_accd(t0, t0, t1, t2, o, o, o, o, 0.1, 1.0) == 1.0);
  CHECK(point_triangle_accd(t0, t0, t1, t2, {0, 0, 1}, o, o, o, 0.1, 1.0) == 0.0);
}

TEST_CASE("ACCD handles parallel, coplanar, collapsed and grazing pairs", "[ccd]") {
  RandomStencils random(36);
  for (int k = 0; k < 1000; ++k) {
    Stencil x = random.any();
    Stencil d = random_motion(random, random.log_uniform(1e-2, 1e2));
    const int variant = k % 5;
    if (variant == 0) x.col(3) = x.col(2) + random.uniform(-2, 2) * (x.col(1) - x.col(0));
    if (variant == 1) x.row(2).setZero(), d.row(2).setZero();
    if (variant == 2) x.col(3) = x.col(2);
    if (variant == 3) x = (2.0 * x).array().round();
    if (variant == 4) x = random.crossing(1e-4, random.log_uniform(1e-12, 1e-3));
    for (const Kind kind : all_kinds) {
      if (distance_at(kind, x, d, 0.0) < 1e-8) continue;
      check_safe(kind, x, d, 0.1, 1.0);
    }
  }
  // A vertex that clears a triangle's corner by 5% of the initial gap, and one that just hits it.
  const Vec3 t0(0, 0, 0), t1(1, 0, 0), t2(0, 1, 0), o(0, 0, 0), p(-0.05, -1, 0);
  CHECK(point_triangle_accd(p, t0, t1, t2, {0, 2, 0}, o, o, o, 0.0, 1.0) == 1.0);
  const double hit = point_triangle_accd({1e-3, -1, 0}, t0, t1, t2, {0, 2, 0}, o, o, o, 0.0, 1.0);
  CHECK(hit < 0.5);
  CHECK(hit > 0.48);
}

TEST_CASE("ACCD refuses invalid parameters", "[ccd]") {
  const Vec3 p(0, 0, 1), q(0, 0, 0), o(0, 0, 0);
  CHECK_THROWS_AS(point_point_accd(p, q, o, o, 1.0, 1.0), InputError);
  CHECK_THROWS_AS(point_point_accd(p, q, o, o, -0.1, 1.0), InputError);
  CHECK_THROWS_AS(point_point_accd(p, q, o, o, 0.1, -1.0), InputError);
  CHECK_THROWS_AS(point_point_accd(p, q, o, o, 0.1, 1.0, -1.0), InputError);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(point_point_accd(p, q, {0, 0, nan}, o, 0.1, 1.0) == 0.0);
  CHECK(point_point_accd(p, q, {0, inf, 0}, o, 0.1, 1.0) == 0.0);
  CHECK(point_point_accd({0, nan, 0}, q, {0, 0, 1}, o, 0.1, 1.0) == 0.0);
}
