// Gradients and Hessians against five-point central differences (error h^4 and eps / h), on random
// stencils and on nearly degenerate ones: slivers, almost parallel edges, small gaps.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/edge_edge_mollifier.hpp"
#include "geometry/distance/point_edge.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "tests/geometry/distance/random_stencils.hpp"

using namespace tack;

namespace {

// Value, value with gradient, and value with gradient and Hessian must agree with each other and
// with the differences of step h.
template <int V, typename Value, typename Gradient, typename Derivatives>
void check(const Value& value, const Gradient& gradient, const Derivatives& derivatives,
           const Stencil& x, double h, double tolerance) {
  const auto d = derivatives(x);
  const auto g = gradient(x);
  // The same formulas; where they are inlined, products and sums may be contracted differently, and a gap is known to the rounding of what it
  // is the difference of.
  const double gap = std::sqrt(d.value), size = (x.leftCols<V>().colwise() - x.col(0)).norm();
  const double rounding = 1e-12 + 4 * std::numeric_limits<double>::epsilon() * size / gap;
  CHECK(g.value == Approx(d.value).epsilon(rounding).margin(1e-28));
  CHECK((g.gradient - d.gradient).norm() <= 1e-9 * d.gradient.norm());
  CHECK(value(x) == Approx(d.value).epsilon(rounding).margin(1e-28));
  const auto slope = numerical_gradient<V>(value, x, h);
  CHECK((slope - d.gradient).norm() <= tolerance * (d.gradient.norm() + h));
  const auto curvature =
      numerical_jacobian<V>([&](const Stencil& y) { return gradient(y).gradient; }, x, h);
  CHECK((curvature - d.hessian).norm() <= tolerance * d.hessian.norm());
}

void check_point_triangle(const Stencil& x, PointTriangleType type, double h, double tolerance) {
  const auto call = [type](auto f) {
    return [f, type](const Stencil& y) { return f(y.col(0), y.col(1), y.col(2), y.col(3), type); };
  };
  using T = PointTriangleType;
  using P = const Vec3&;
  check<4>(call([](P a, P b, P c, P d, T t) { return point_triangle_distance(a, b, c, d, t); }),
           call([](P a, P b, P c, P d, T t) { return point_triangle_gradient(a, b, c, d, t); }),
           call([](P a, P b, P c, P d, T t) { return point_triangle_derivatives(a, b, c, d, t); }),
           x, h, tolerance);
}

void check_edge_edge(const Stencil& x, EdgeEdgeType type, double h, double tolerance) {
  const auto call = [type](auto f) {
    return [f, type](const Stencil& y) { return f(y.col(0), y.col(1), y.col(2), y.col(3), type); };
  };
  using T = EdgeEdgeType;
  using P = const Vec3&;
  check<4>(call([](P a, P b, P c, P d, T t) { return edge_edge_distance(a, b, c, d, t); }),
           call([](P a, P b, P c, P d, T t) { return edge_edge_gradient(a, b, c, d, t); }),
           call([](P a, P b, P c, P d, T t) { return edge_edge_derivatives(a, b, c, d, t); }), x, h,
           tolerance);
}

void check_point_edge(const Stencil& x, PointEdgeType type, double h, double tolerance) {
  const auto call = [type](auto f) {
    return [f, type](const Stencil& y) { return f(y.col(0), y.col(1), y.col(2), type); };
  };
  using T = PointEdgeType;
  using P = const Vec3&;
  check<3>(call([](P a, P b, P c, T t) { return point_edge_distance(a, b, c, t); }),
           call([](P a, P b, P c, T t) { return point_edge_gradient(a, b, c, t); }),
           call([](P a, P b, P c, T t) { return point_edge_derivatives(a, b, c, t); }), x, h,
           tolerance);
}

}  // namespace

TEST_CASE("distance derivatives of every type match central differences", "[distance]") {
  RandomStencils random(11);
  for (int k = 0; k < 20; ++k) {
    const Stencil x = random.any();
    for (int t = 0; t < 3; ++t) check_point_edge(x, PointEdgeType(t), 1e-3, 1e-6);
    for (int t = 0; t < 6; ++t) check_point_triangle(x, PointTriangleType(t), 1e-3, 1e-6);
    for (int t = 0; t < 8; ++t) check_edge_edge(x, EdgeEdgeType(t), 1e-3, 1e-6);
  }
}

TEST_CASE("point-triangle derivatives hold for small gaps and slivers", "[distance]") {
  RandomStencils random(12);
  for (int k = 0; k < 100; ++k) {
    const double height = random.log_uniform(1e-3, 1.0);
    const Stencil x = random.above_triangle(random.log_uniform(1e-6, 0.1), height);
    check_point_triangle(x, PointTriangleType::P_T, 1e-3 * height, 1e-5);
  }
}

TEST_CASE("edge-edge derivatives hold for small gaps and nearly parallel edges", "[distance]") {
  RandomStencils random(13);
  for (int k = 0; k < 100; ++k) {
    const double angle = random.log_uniform(1e-3, 1.0);
    const Stencil x = random.crossing(random.log_uniform(1e-6, 0.1), angle);
    check_edge_edge(x, EdgeEdgeType::EA_EB, 1e-3 * angle, 1e-5);
  }
}

TEST_CASE("clamped distances are C1 across the borders of their regions", "[distance]") {
  RandomStencils random(14);
  for (int k = 0; k < 300; ++k) {
    const Stencil a = random.any(), b = random.any();
    double low = 0.0, high = 1.0;  // bisect for a change of type between a and b
    const auto at = [&](double t) -> Stencil { return (1 - t) * a + t * b; };
    const auto type = [&](double t) {
      const Stencil x = at(t);
      return point_triangle_type(x.col(0), x.col(1), x.col(2), x.col(3));
    };
    if (type(low) == type(high)) continue;
    while (high - low > 1e-14) {
      const double middle = 0.5 * (low + high);
      (type(middle) == type(low) ? low : high) = middle;
    }
    const Stencil x = at(low), y = at(high);
    const auto f = point_triangle_gradient(x.col(0), x.col(1), x.col(2), x.col(3));
    const auto g = point_triangle_gradient(y.col(0), y.col(1), y.col(2), y.col(3));
    CAPTURE(x, static_cast<int>(type(low)), static_cast<int>(type(high)), low, high);
    CHECK(f.value == Approx(g.value).margin(1e-12));
    const Vec3 e1 = x.col(2) - x.col(1), e2 = x.col(3) - x.col(1);
    const double sine = e1.cross(e2).norm() / (e1.norm() * e2.norm());
    const double border = 1e-12 + 1e-14 / (sine * sine);  // where rounding puts the border
    CHECK((f.gradient - g.gradient).norm() < border * (1.0 + f.gradient.norm()));
  }
}

TEST_CASE("mollifier derivatives match central differences", "[distance]") {
  RandomStencils random(15);
  const double eps_x = 1e-3;
  const auto call = [eps_x](auto f) {
    return
        [f, eps_x](const Stencil& y) { return f(y.col(0), y.col(1), y.col(2), y.col(3), eps_x); };
  };
  using P = const Vec3&;
  for (int k = 0; k < 50; ++k) {
    const double angle = random.log_uniform(1e-3, 0.02);
    check<4>(call([](P a, P b, P c, P d, double e) { return edge_edge_mollifier(a, b, c, d, e); }),
             call([](P a, P b, P c, P d, double e) {
               return edge_edge_mollifier_gradient(a, b, c, d, e);
             }),
             call([](P a, P b, P c, P d, double e) {
               return edge_edge_mollifier_derivatives(a, b, c, d, e);
             }),
             random.crossing(1e-2, angle), 1e-4 * angle, 1e-7);
  }
}
