// Projections onto lines and planes, and distances to them: orthogonality, closed forms, and
// derivatives against differences.
#include <catch2/catch.hpp>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "geometry/distance/box_gap.hpp"
#include "geometry/distance/line_line.hpp"
#include "geometry/distance/point_line.hpp"
#include "geometry/distance/point_plane.hpp"
#include "geometry/distance/squared_distance.hpp"

using namespace tack;

namespace {

class Points {
 public:
  explicit Points(unsigned seed) : generator_(seed) {}
  Vec3 operator()() { return {number(), number(), number()}; }
  double number() { return std::uniform_real_distribution<double>(-1, 1)(generator_); }
  Mat3 rotation() { return Eigen::AngleAxisd(3 * number(), (*this)().normalized()).toRotationMatrix(); }

 private:
  std::mt19937 generator_;
};

// Returns the largest difference of the derivatives from central differences of value(c), c stacked corners, relative to the largest.
template <int N, class Value, class Derivatives>
double error_of(const std::array<Vec3, N>& c, const Value& value, const Derivatives& derivatives) {
  const double h = 1e-5;
  const auto exact = derivatives(c);
  double error = 0;
  for (int i = 0; i < 3 * N; ++i) {
    auto forth = c, back = c;
    forth[i / 3][i % 3] += h;
    back[i / 3][i % 3] -= h;
    error = std::max(error, std::abs((value(forth) - value(back)) / (2 * h) - exact.gradient[i]) / (1e-3 + exact.gradient.cwiseAbs().maxCoeff()));
    const auto slope = ((derivatives(forth).gradient - derivatives(back).gradient) / (2 * h)).eval();
    error = std::max(error, (slope - exact.hessian.col(i)).cwiseAbs().maxCoeff() / (1e-3 + exact.hessian.cwiseAbs().maxCoeff()));
  }
  return error;
}

}  // namespace

TEST_CASE("the residual of a projection is orthogonal to the span, and the shortest", "[distance]") {
  Points random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 offset = random(), a = random(), b = random();
    const LineProjection line = project_onto_line(offset, a);
    CHECK((offset + line.u * a - line.residual).norm() < 1e-14);
    CHECK(std::abs(line.residual.dot(a)) < 1e-14);
    const PlaneProjection plane = project_onto_plane(offset, a, b);
    CHECK((offset + plane.u * a + plane.v * b - plane.residual).norm() < 1e-12);
    CHECK(std::abs(plane.residual.dot(a)) < 1e-12);
    CHECK(std::abs(plane.residual.dot(b)) < 1e-12);
    CHECK(plane.dual_a.dot(a) == Approx(1));
    CHECK(plane.dual_b.dot(b) == Approx(1));
    CHECK(std::abs(plane.dual_a.dot(b)) < 1e-10);
    for (int k = 0; k < 5; ++k) {
      CHECK((offset + random.number() * a).norm() >= line.residual.norm() * (1 - 1e-14));
      CHECK((offset + random.number() * a + random.number() * b).norm() >= plane.residual.norm() * (1 - 1e-12));
    }
  }
}

TEST_CASE("a residual keeps its direction where the gap is a billionth of the size", "[distance]") {
  Points random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 a = random(), b = random(), n = a.cross(b).normalized();
    const Vec3 offset = 0.3 * a - 0.4 * b + 1e-9 * n;
    const Vec3 r = project_onto_plane(offset, a, b).residual, beside = project_onto_line(0.3 * a + 1e-9 * n, a).residual;
    // Rounding of the offset, 1e-16, would tilt them by 1e-7.
    for (const Vec3& along : {a, b}) CHECK(std::abs(r.normalized().dot(along.normalized())) < 1e-11);
    CHECK(std::abs(beside.normalized().dot(a.normalized())) < 1e-12);
    CHECK(r.norm() == Approx(1e-9).epsilon(1e-5));
  }
}

TEST_CASE("distances to lines and planes have closed forms by cross products", "[distance]") {
  Points random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 p = random(), a = random(), b = random(), c = random();
    CHECK(point_line_distance(p, a, b) == Approx((b - a).cross(p - a).squaredNorm() / (b - a).squaredNorm()));
    const Vec3 n = (b - a).cross(c - a).normalized(), m = (a - p).cross(c - b).normalized();
    CHECK(point_plane_distance(p, a, b, c) == Approx(std::pow(n.dot(p - a), 2)).margin(1e-14));
    CHECK(line_line_distance(p, a, b, c) == Approx(std::pow(m.dot(b - p), 2)).margin(1e-14));
  }
}

TEST_CASE("distances to lines and planes do not depend on motions or on the order of the corners", "[distance]") {
  Points random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 p = random(), a = random(), b = random(), c = random(), d = 3 * random();
    const Mat3 r = random.rotation();
    const auto m = [&](const Vec3& x) { return Vec3(r * x + d); };
    CHECK(point_line_distance(m(p), m(b), m(a)) == Approx(point_line_distance(p, a, b)).margin(1e-12));
    CHECK(point_plane_distance(m(p), m(c), m(a), m(b)) == Approx(point_plane_distance(p, a, b, c)).margin(1e-12));
    CHECK(point_plane_distance(p, b, a, c) == Approx(point_plane_distance(p, a, b, c)).margin(1e-12));
    CHECK(line_line_distance(m(b), m(c), m(a), m(p)) == Approx(line_line_distance(p, a, b, c)).margin(1e-12));
  }
}

TEST_CASE("derivatives of distances to lines and planes are those of the value", "[distance]") {
  Points random(5);
  for (int trial = 0; trial < 30; ++trial) {
    const std::array<Vec3, 3> c3 = {random(), random(), random()};
    const std::array<Vec3, 4> c4 = {random(), random(), random(), random()};
    if ((c3[1] - c3[2]).norm() < 0.4 || (c4[1] - c4[0]).normalized().cross((c4[3] - c4[2]).normalized()).norm() < 0.4 ||
        (c4[2] - c4[1]).normalized().cross((c4[3] - c4[1]).normalized()).norm() < 0.4 || (c4[2] - c4[1]).norm() < 0.4 || (c4[3] - c4[1]).norm() < 0.4 ||
        (c4[1] - c4[0]).norm() < 0.4 || (c4[3] - c4[2]).norm() < 0.4)
      continue;
    CHECK(error_of<3>(c3, [](const auto& c) { return point_line_distance(c[0], c[1], c[2]); },
                      [](const auto& c) { return point_line_derivatives(c[0], c[1], c[2]); }) < 1e-6);
    CHECK(error_of<4>(c4, [](const auto& c) { return point_plane_distance(c[0], c[1], c[2], c[3]); },
                      [](const auto& c) { return point_plane_derivatives(c[0], c[1], c[2], c[3]); }) < 1e-6);
    CHECK(error_of<4>(c4, [](const auto& c) { return line_line_distance(c[0], c[1], c[2], c[3]); },
                      [](const auto& c) { return line_line_derivatives(c[0], c[1], c[2], c[3]); }) < 1e-6);
    CHECK((point_plane_gradient(c4[0], c4[1], c4[2], c4[3]).gradient - point_plane_derivatives(c4[0], c4[1], c4[2], c4[3]).gradient).norm() < 1e-12);
    CHECK((line_line_gradient(c4[0], c4[1], c4[2], c4[3]).gradient - line_line_derivatives(c4[0], c4[1], c4[2], c4[3]).gradient).norm() < 1e-12);
    CHECK((point_line_gradient(c3[0], c3[1], c3[2]).gradient - point_line_derivatives(c3[0], c3[1], c3[2]).gradient).norm() < 1e-12);
  }
}

TEST_CASE("vectors are nearly parallel below an angle of 1e-10, and if one of them is zero", "[distance]") {
  const Vec3 a(1, 2, 3), across = a.unitOrthogonal() * a.norm();
  CHECK(nearly_parallel(a, 7 * a));
  CHECK(nearly_parallel(a, -a));
  CHECK(nearly_parallel(a, a + 0.5e-10 * across));
  CHECK_FALSE(nearly_parallel(a, a + 2e-10 * across));
  CHECK(nearly_parallel(a, Vec3::Zero()));
}

TEST_CASE("gaps of boxes are lower bounds of the distance, and exact along one axis", "[distance]") {
  Points random(6);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 aside = 2 * random();
    const std::array<Vec3, 1> p = {Vec3(random() + aside)};
    const std::array<Vec3, 3> t = {random(), random(), random()};
    const std::array<Vec3, 2> e = {random(), random()}, f = {Vec3(random() + aside), Vec3(random() + aside)};
    CHECK(box_gaps(p, t).cwiseMax(0.0).squaredNorm() <= squared_distance(p, t) * (1 + 1e-12));
    CHECK(box_gaps(e, f).cwiseMax(0.0).squaredNorm() <= squared_distance(e, f) * (1 + 1e-12));
    CHECK(box_gaps(p, t) == box_gaps(t, p));
  }
  const std::array<Vec3, 2> low = {Vec3(0, 0, 0), Vec3(1, 1, 1)}, high = {Vec3(3, 0.5, -4), Vec3(4, 0.6, -2)};
  CHECK(box_gaps(low, high) == Vec3(2, -0.5, 2));
}
