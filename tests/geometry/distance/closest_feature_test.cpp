// Classification and closest-point parameters against a direct minimisation over the parameters, on
// random and degenerate input; invariance under rigid motion and renumbering.
#include "geometry/distance/closest_feature.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "geometry/distance/closest_parameters.hpp"
#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/point_edge.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "tests/geometry/distance/random_stencils.hpp"

using namespace tack;

namespace {

// Returns the smallest |x - (e0 + t (e1 - e0))|^2 over t in [0, 1], independent of the code under test.
double segment_minimum(const Vec3& x, const Vec3& e0, const Vec3& e1) {
  const Vec3 e = e1 - e0;
  const double length = e.dot(e);
  const double t = length > 0 ? std::clamp(e.dot(x - e0) / length, 0.0, 1.0) : 0.0;
  return (x - (1 - t) * e0 - t * e1).squaredNorm();
}

// Returns the minimum of a convex function on [0, 1] by golden-section search.
template <typename F>
double minimum(const F& f) {
  const double ratio = 0.6180339887498949;
  double low = 0.0, high = 1.0;
  double best = std::min(f(low), f(high));
  for (int k = 0; k < 80; ++k) {
    const double left = high - ratio * (high - low), right = low + ratio * (high - low);
    const double at_left = f(left), at_right = f(right);
    best = std::min({best, at_left, at_right});
    (at_left < at_right ? high : low) = at_left < at_right ? right : left;
  }
  return best;
}

double brute_point_triangle(const Stencil& x) {
  return minimum([&](double v) {  // slices of the triangle parallel to t0 t1
    return segment_minimum(x.col(0), (1 - v) * x.col(1) + v * x.col(3),
                           (1 - v) * x.col(2) + v * x.col(3));
  });
}

double brute_edge_edge(const Stencil& x) {
  return minimum([&](double u) {
    return segment_minimum((1 - u) * x.col(0) + u * x.col(1), x.col(2), x.col(3));
  });
}

// Random, axis-aligned (many ties), slivers, nearly parallel, collapsed.
std::vector<Stencil> samples() {
  RandomStencils random(21);
  std::vector<Stencil> all;
  for (int k = 0; k < 2000; ++k) {
    const Stencil x = random.any();
    all.push_back(x);
    all.push_back((2.0 * x).array().round());  // vertices on a grid coincide, align, degenerate
    Stencil sliver = x;
    sliver.col(3) = x.col(2) + random.uniform(-1, 2) * (x.col(1) - x.col(2)) +
                    random.log_uniform(1e-14, 1e-1) * random.vector();
    all.push_back(sliver);
    Stencil parallel = x;
    parallel.col(3) = x.col(2) + random.uniform(-2, 2) * (x.col(1) - x.col(0)) +
                      random.log_uniform(1e-14, 1e-1) * random.vector();
    all.push_back(parallel);
    Stencil collapsed = x;
    collapsed.col(k % 4) = x.col((k / 4) % 4);
    all.push_back(collapsed);
    all.push_back(random.crossing(random.log_uniform(1e-8, 1), random.log_uniform(1e-10, 1)));
    all.push_back(random.above_triangle(random.log_uniform(1e-8, 1), random.log_uniform(1e-8, 1)));
  }
  return all;
}

// The search above resolves the squared distance to about 1e-14 of the coordinates squared.
bool agrees(double s, double brute) { return std::abs(s - brute) <= 1e-12 * brute + 2e-14; }

// Error of the closest points of nearly parallel edges (span_projection.hpp); the shortest vector is more accurate.
double parameter_error(const Vec3& a, const Vec3& b) {
  const double sine = a.cross(b).norm() / std::max(a.norm() * b.norm(), 1e-300);
  return 1e-15 / std::max(sine, 1e-10);
}

int index(auto type) { return static_cast<int>(type); }

}  // namespace

TEST_CASE("point-triangle distance is the minimum over the triangle", "[distance]") {
  std::array<int, 7> seen{};
  for (const Stencil& x : samples()) {
    const Vec3 p = x.col(0), t0 = x.col(1), t1 = x.col(2), t2 = x.col(3);
    const PointTriangleType type = point_triangle_type(p, t0, t1, t2);
    const double s = point_triangle_distance(p, t0, t1, t2);
    const double brute = brute_point_triangle(x);
    const Vec3 l = point_triangle_barycentric(p, t0, t1, t2);
    const double at_closest = (p - l[0] * t0 - l[1] * t1 - l[2] * t2).squaredNorm();
    const Vec3 shortest = point_triangle_separation(p, t0, t1, t2);
    ++seen[index(type)];
    const bool good = agrees(s, brute) && agrees(at_closest, brute) && l.minCoeff() >= -1e-15 &&
                      std::abs(l.sum() - 1) < 1e-14 &&
                      shortest.squaredNorm() == Approx(s).margin(1e-30);
    if (!good) {
      CAPTURE(x, index(type), s, brute, at_closest, l.transpose());
      CHECK(good);
    }
  }
  for (const int count : seen) CHECK(count > 100);
}

TEST_CASE("edge-edge distance is the minimum over both edges", "[distance]") {
  std::array<int, 9> seen{};
  for (const Stencil& x : samples()) {
    const Vec3 ea0 = x.col(0), ea1 = x.col(1), eb0 = x.col(2), eb1 = x.col(3);
    const EdgeEdgeType type = edge_edge_type(ea0, ea1, eb0, eb1);
    const double s = edge_edge_distance(ea0, ea1, eb0, eb1);
    const double brute = brute_edge_edge(x);
    const Vec2 at = edge_edge_parameters(ea0, ea1, eb0, eb1);
    const Vec3 between = (1 - at[0]) * ea0 + at[0] * ea1 - (1 - at[1]) * eb0 - at[1] * eb1;
    const Vec3 shortest = edge_edge_separation(ea0, ea1, eb0, eb1);
    ++seen[index(type)];
    const bool good = agrees(s, brute) && agrees(between.squaredNorm(), brute) &&
                      at.minCoeff() >= 0 && at.maxCoeff() <= 1 &&
                      (shortest - between).norm() < 1e-13 + parameter_error(ea1 - ea0, eb1 - eb0);
    if (!good) {
      CAPTURE(x, index(type), s, brute, at.transpose(), shortest, between);
      CHECK(good);
    }
  }
  for (const int count : seen) CHECK(count > 100);
}

TEST_CASE("point-edge distance is the minimum over the edge", "[distance]") {
  std::array<int, 3> seen{};
  for (const Stencil& x : samples()) {
    const Vec3 p = x.col(0), e0 = x.col(1), e1 = x.col(2);
    const double s = point_edge_distance(p, e0, e1);
    const double u = point_edge_parameter(p, e0, e1);
    const PointEdgeType type = point_edge_type(p, e0, e1);
    ++seen[index(type)];
    const bool good = agrees(s, segment_minimum(p, e0, e1)) && u >= 0 && u <= 1 &&
                      agrees((p - (1 - u) * e0 - u * e1).squaredNorm(), s) &&
                      point_edge_distance(p, e0, e1, type) == Approx(s).margin(1e-30);
    if (!good) {
      CAPTURE(x, index(type), s, u);
      CHECK(good);
    }
  }
  for (const int count : seen) CHECK(count > 100);
}

TEST_CASE("small gaps keep their relative accuracy", "[distance]") {
  RandomStencils random(22);
  for (int k = 0; k < 500; ++k) {
    const double gap = random.log_uniform(1e-9, 1e-3);
    const double error = 1e-14 / gap;                 // coordinates are rounded to 1e-16
    const double thin = random.log_uniform(1e-4, 1);  // sine of the angle in the span
    const Stencil x = random.above_triangle(gap, thin);
    const Vec3 r = point_triangle_separation(x.col(0), x.col(1), x.col(2), x.col(3));
    CHECK(r.norm() == Approx(gap).epsilon(error));
    const Stencil y = random.crossing(gap, thin);
    const Vec3 q = edge_edge_separation(y.col(0), y.col(1), y.col(2), y.col(3));
    CHECK(q.norm() == Approx(gap).epsilon(error));
    // The direction must not tilt, whatever the gap: it is orthogonal to both features.
    CHECK(std::abs(r.dot(x.col(2) - x.col(1))) < 1e-14 * gap / thin);
    CHECK(std::abs(q.dot(y.col(1) - y.col(0))) < 1e-14 * gap / thin);
  }
}

TEST_CASE("distances ignore rigid motion and renumbering", "[distance]") {
  RandomStencils random(23);
  for (int k = 0; k < 200; ++k) {
    const Stencil x = random.any();
    const Mat3 r = random.rotation();
    const Stencil y = (r * x).colwise() + random.vector();
    const auto d = [](const Stencil& z, int i, int j, int l) {
      return point_triangle_derivatives(z.col(0), z.col(i), z.col(j), z.col(l));
    };
    const auto before = d(x, 1, 2, 3), after = d(y, 1, 2, 3);
    CHECK(after.value == Approx(before.value));
    for (int i = 0; i < 4; ++i) {
      CHECK(after.gradient.segment<3>(3 * i).isApprox(r * before.gradient.segment<3>(3 * i), 1e-9));
      for (int j = 0; j < 4; ++j) {
        const Mat3 turned = r * before.hessian.block<3, 3>(3 * i, 3 * j) * r.transpose();
        CHECK((after.hessian.block<3, 3>(3 * i, 3 * j) - turned).norm() <
              1e-9 * before.hessian.norm());
      }
    }
    // Translations cost nothing: gradients and Hessian rows sum to zero.
    CHECK(before.gradient.reshaped(3, 4).rowwise().sum().norm() < 1e-13 * before.gradient.norm());
    CHECK(d(x, 2, 3, 1).value == Approx(before.value));
    CHECK(d(x, 3, 2, 1).value == Approx(before.value));
    const auto e = [&x](int a, int b, int c, int f) {
      return edge_edge_gradient(x.col(a), x.col(b), x.col(c), x.col(f));
    };
    const auto g = e(0, 1, 2, 3), swapped = e(2, 3, 1, 0);
    CHECK(swapped.value == Approx(g.value));
    CHECK(swapped.gradient.segment<6>(0).isApprox(g.gradient.segment<6>(6), 1e-9));
    CHECK(swapped.gradient.segment<3>(6).isApprox(g.gradient.segment<3>(3), 1e-9));
  }
}
