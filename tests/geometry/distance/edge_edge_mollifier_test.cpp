// The mollifier's closed form: 0 for parallel edges, 1 beyond the threshold, C1 in between.
#include "geometry/distance/edge_edge_mollifier.hpp"

#include <catch2/catch.hpp>

using namespace tack;

TEST_CASE("the mollifier rises from 0 to 1 and is C1 at its threshold", "[distance]") {
  const double eps_x = 2e-4;
  CHECK(mollifier_value(0.0, eps_x) == 0.0);
  CHECK(mollifier_value(0.5 * eps_x, eps_x) == Approx(0.75));
  CHECK(mollifier_value(eps_x, eps_x) == 1.0);
  CHECK(mollifier_value(7.0, eps_x) == 1.0);
  CHECK(mollifier_slope(0.0, eps_x) == Approx(2.0 / eps_x));
  const double just_below = eps_x * (1 - 1e-12);
  CHECK(mollifier_value(just_below, eps_x) == Approx(1.0).epsilon(1e-15));
  CHECK(std::abs(mollifier_slope(just_below, eps_x)) < 1e-11 / eps_x);
  CHECK(mollifier_slope(eps_x, eps_x) == 0.0);
}

TEST_CASE("the mollifier's threshold is relative to the rest lengths", "[distance]") {
  const Vec3 o(0, 0, 0), a(2, 0, 0), b(0, 0, 1), c(0, 3, 1);
  CHECK(edge_edge_mollifier_threshold(o, a, b, c) == Approx(1e-3 * 4 * 9));
  CHECK(edge_edge_cross_squared(o, a, b, c) == Approx(36));
  const auto far = edge_edge_mollifier_derivatives(o, a, b, c, 0.036);
  CHECK(far.value == 1.0);
  CHECK(far.gradient.isZero(0));
  CHECK(far.hessian.isZero(0));
}

TEST_CASE("parallel and zero-length edges have a finite mollifier", "[distance]") {
  const Vec3 o(0, 0, 0), a(1, 0, 0), b(0, 0, 1), c(2, 0, 1);
  const auto parallel = edge_edge_mollifier_derivatives(o, a, b, c, 4e-3);
  CHECK(parallel.value == 0.0);
  CHECK(parallel.gradient.isZero(0));
  CHECK(parallel.hessian.allFinite());
  const double none = edge_edge_mollifier_threshold(o, o, b, c);
  CHECK(none == 0.0);
  CHECK(edge_edge_mollifier(o, o, b, c, none) == 1.0);
}
