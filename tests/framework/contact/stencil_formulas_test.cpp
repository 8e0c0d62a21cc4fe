// Formulas of contact stencils: the chain rule of an interior point, and second derivatives of a
// distance by its frame.
#include <catch2/catch.hpp>
#include <Eigen/Geometry>
#include <cmath>

#include "framework/contact/stencils/distance_frame.hpp"
#include "framework/contact/stencils/chain_to_triangle.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "tests/framework/contact/surface_builder.hpp"

using namespace tack;

namespace {

using MatX = Eigen::MatrixXd;

// The Hessian of the distance by the formula of distance_frame.hpp.
template <int K>
MatX hessian_of(const DistanceFrame<K>& f) {
  const double d = f.residual.norm();
  const Vec3 n = f.residual / d, t1 = f.along, t2 = n.cross(t1);
  MatX h = MatX::Zero(3 * K, 3 * K);
  for (int i = 0; i < K; ++i)
    for (int j = 0; j < K; ++j) {
      const Vec3 qi = f.duals.col(i), qj = f.duals.col(j);
      h.block<3, 3>(3 * i, 3 * j) = -f.weights[i] * qj * n.transpose() - f.weights[j] * n * qi.transpose() - d * qi.dot(qj) * n * n.transpose() +
                                    f.weights[i] * f.weights[j] / d * (f.free[0] * t1 * t1.transpose() + f.free[1] * t2 * t2.transpose());
    }
  return h;
}

// Returns the Hessian of the distance by differences.
template <int K, class Squared>
MatX hessian_by_differences(const std::array<Vec3, K>& at, const Squared& squared) {
  const double h = 1e-4;
  MatX m(3 * K, 3 * K);
  const auto value = [&](int i, double a, int j, double b) {
    auto c = at;
    c[i / 3][i % 3] += a;
    c[j / 3][j % 3] += b;
    return std::sqrt(squared(c));
  };
  for (int i = 0; i < 3 * K; ++i)
    for (int j = 0; j < 3 * K; ++j) m(i, j) = (value(i, h, j, h) - value(i, h, j, -h) - value(i, -h, j, h) + value(i, -h, j, -h)) / (4 * h * h);
  return m;
}

}  // namespace

TEST_CASE("the frame of a distance gives its second derivatives", "[contact][frame]") {
  RandomPoints random(1);
  for (int trial = 0; trial < 10; ++trial) {
    // A point above the inside of features of size one.
    const Vec3 a = random.point(0.1), b = Vec3(1, 0, 0) + random.point(0.1), c = Vec3(0, 1, 0) + random.point(0.1), p = Vec3(0.3, 0.2, 0.5) + random.point(0.1);
    const Vec3 e = Vec3(0.2, -0.5, 0.6) + random.point(0.1), f = Vec3(0.3, 0.7, 0.4) + random.point(0.1);
    const auto close = [](const MatX& one, const MatX& other) { return (one - other).cwiseAbs().maxCoeff() < 1e-5 * other.cwiseAbs().maxCoeff(); };
    CHECK(close(hessian_of(FrameKernels::point_point(p, a)), hessian_by_differences<2>({p, a}, [](const auto& x) { return (x[0] - x[1]).squaredNorm(); })));
    CHECK(close(hessian_of(FrameKernels::point_line(p, a, b)), hessian_by_differences<3>({p, a, b}, [](const auto& x) { return point_line_distance(x[0], x[1], x[2]); })));
    CHECK(close(hessian_of(FrameKernels::point_plane(p, a, b, c)),
                hessian_by_differences<4>({p, a, b, c}, [](const auto& x) { return point_plane_distance(x[0], x[1], x[2], x[3]); })));
    CHECK(close(hessian_of(FrameKernels::line_line(a, b, e, f)), hessian_by_differences<4>({a, b, e, f}, [](const auto& x) { return line_line_distance(x[0], x[1], x[2], x[3]); })));
  }
}

TEST_CASE("the weights of a frame sum up to zero, and give the shortest vector", "[contact][frame]") {
  RandomPoints random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const std::array<Vec3, 4> x = {random.point(1), random.point(1), random.point(1), random.point(1)};
    for (const DistanceFrame<4>& f : {FrameKernels::point_plane(x[0], x[1], x[2], x[3]), FrameKernels::line_line(x[0], x[1], x[2], x[3])}) {
      Vec3 r = Vec3::Zero();
      for (int i = 0; i < 4; ++i) r += f.weights[i] * x[i];
      CHECK(std::abs(f.weights.sum()) < 1e-12);
      CHECK((r - f.residual).norm() < 1e-10);
      CHECK(std::abs(f.along.dot(f.residual)) < 1e-10);
      CHECK(f.along.norm() == Approx(1));
    }
  }
}

TEST_CASE("derivatives by an interior point become those by the corners of its triangle", "[contact][chain]") {
  RandomPoints random(3);
  const std::array<Vec3, 3> own = {random.point(0.2), Vec3(Vec3(1, 0, 0) + random.point(0.2)), Vec3(Vec3(0, 1, 0) + random.point(0.2))};
  const std::array<Vec3, 3> other = {Vec3(-1, -1, -1), Vec3(2, -1, -1.1), Vec3(-1, 2, -0.9)};
  const Vec3 b(0.2, 0.5, 0.3);
  const auto at = [&](const std::array<Vec3, 6>& x) { return Vec3(b[0] * x[0] + b[1] * x[1] + b[2] * x[2]); };
  const auto squared = [&](const std::array<Vec3, 6>& x) { return point_triangle_distance(at(x), x[3], x[4], x[5]); };
  const std::array<Vec3, 6> x = {own[0], own[1], own[2], other[0], other[1], other[2]};
  const Vec3 p = at(x);
  const auto chained = chain_to_triangle(point_triangle_derivatives(p, x[3], x[4], x[5], point_triangle_type(p, x[3], x[4], x[5])), b);
  CHECK(chained.value == Approx(squared(x)));
  const double h = 1e-4;
  for (int i = 0; i < 18; ++i) {
    auto forth = x, back = x;
    forth[i / 3][i % 3] += h;
    back[i / 3][i % 3] -= h;
    CHECK(chained.gradient[i] == Approx((squared(forth) - squared(back)) / (2 * h)).margin(1e-6));
    for (int j = 0; j < 18; ++j) {
      auto ff = forth, fb = forth, bf = back, bb = back;
      ff[j / 3][j % 3] += h;
      fb[j / 3][j % 3] -= h;
      bf[j / 3][j % 3] += h;
      bb[j / 3][j % 3] -= h;
      CHECK(chained.hessian(i, j) == Approx((squared(ff) - squared(fb) - squared(bf) + squared(bb)) / (4 * h * h)).margin(1e-5));
    }
  }
  // Moving the whole triangle moves the point.
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < 3; ++i) sum += chained.gradient.segment<3>(3 * i);
  CHECK((sum - 2 * point_triangle_separation(p, x[3], x[4], x[5])).norm() < 1e-9);
}
