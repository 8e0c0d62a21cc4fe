#include "framework/affine/orthogonality_term.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "tests/support/dense_term.hpp"
#include "tests/support/random_blocks.hpp"

using namespace tack;

namespace {

struct Frames {
  Frames() {
    rest = random.vectors(24);
    term.add({0, 1, 2, 3}, rest, 0.3, 50);
    term.add({4, 6, 5, 7}, rest, 0.1, 80);
  }
  RandomMotions random{3};
  VecX rest;
  OrthogonalityTerm term;
};

}  // namespace

TEST_CASE("orthogonality: derivatives are those of the value", "[affine]") {
  Frames f;
  const VecX x = f.rest + 0.3 * f.random.vectors(24);
  const VecX slopes = gradient_by_differences([&](const VecX& y) { return f.term.value(y); }, x, 1e-4);
  CHECK((slopes - dense_gradient(f.term, x)).norm() <= 1e-8 * slopes.norm());
  const MatX curvatures = hessian_by_differences([&](const VecX& y) { return dense_gradient(f.term, y); }, x, 1e-4);
  const MatX exact = dense_hessian(f.term, x, Projection::none);
  CHECK((curvatures - exact).norm() <= 1e-8 * curvatures.norm());
  CHECK(smallest_eigenvalue(dense_hessian(f.term, x, Projection::clamp)) >= -1e-9 * exact.norm());
}

TEST_CASE("orthogonality: rigid motions are free, a stretch costs kappa/2 V e^2", "[affine]") {
  Frames f;
  const Mat3 r = Eigen::AngleAxisd(2.0, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  VecX x = f.rest;
  for (int v = 0; v < 8; ++v) vertex(x, v) = r * vertex(f.rest, v) + Vec3(4, 5, 6);
  CHECK(f.term.value(x) < 1e-24);
  CHECK(f.term.largest_strain(x) < 1e-14);
  const double stretch = 1e-3;
  x = f.rest;
  for (int v = 0; v < 8; ++v) x(3 * v) *= 1 + stretch;
  const double strain = stretch + stretch * stretch / 2;
  CHECK(f.term.value(x) == Approx((50 * 0.3 + 80 * 0.1) / 2 * strain * strain));
  CHECK(f.term.largest_strain(x) == Approx(strain));
}

TEST_CASE("orthogonality as least squares", "[affine]") {
  Frames f;
  const VecX x = f.rest + 0.2 * f.random.vectors(24);
  std::vector<double> r(12), jacobian(12 * 12);
  REQUIRE(f.term.residuals(x, r.data(), jacobian.data()));
  double sum = 0;
  for (const double residual : r) sum += residual * residual / 2;
  CHECK(sum == Approx(f.term.value(x)));
  VecX gradient = VecX::Zero(24);
  const Tet frames[] = {{0, 1, 2, 3}, {4, 6, 5, 7}};
  for (int b = 0; b < 2; ++b)
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < 4; ++k)
        vertex(gradient, frames[b][k]) += r[6 * b + i] * Eigen::Map<const Vec3>(jacobian.data() + 12 * (6 * b + i) + 3 * k);
  CHECK((gradient - dense_gradient(f.term, x)).norm() <= 1e-12 * gradient.norm());
}

TEST_CASE("orthogonality: retracted steps rotate bodies about centroids on linear trajectories", "[affine]") {
  Frames f;
  const std::vector<char> free(8, 1);
  const DofMap dofs(free);
  VecX q, p = VecX::Zero(24);
  dofs.gather(f.rest, q);
  const Vec3 spin(0.5, -0.8, 0.3), velocity(2, 1, 0);
  for (int v = 0; v < 4; ++v) p.segment<3>(3 * v) = velocity + spin.cross(Vec3(q.segment<3>(3 * v)));
  p.tail<12>() = f.random.vectors(12).segment<3>(0).replicate<4, 1>();  // translates the body
  const VecX straight = p;
  REQUIRE(f.term.retract(dofs, q, p, 1e-3));
  CHECK(f.term.value(q + straight) > 1e-3);
  CHECK(f.term.value(q + p) < 1e-20);
  const auto mean = [](const VecX& x) { return Vec3((x.segment<3>(0) + x.segment<3>(3) + x.segment<3>(6) + x.segment<3>(9)) / 4); };
  CHECK((mean(p) - mean(straight)).norm() < 1e-14);
  CHECK(p.tail<12>() == straight.tail<12>());
  VecX cheap = straight;
  CHECK_FALSE(f.term.retract(dofs, q, cheap, 1.01 * f.term.value(q + straight)));
  CHECK(cheap == straight);
  // A body with fixed vertices is not retracted.
  std::vector<char> partly_free(8, 1);
  partly_free[0] = 0;
  const DofMap fewer(partly_free);
  VecX r, s = straight.tail<21>();
  fewer.gather(f.rest, r);
  CHECK_FALSE(f.term.retract(fewer, r, s, 1e-3));
}
