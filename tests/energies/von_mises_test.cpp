// Von Mises plasticity at a point (a box that deforms homogeneously), against closed forms. The yield surface is one of
// Kirchhoff stress and strains are logarithmic, so that those forms hold at any size of strain.
#include <Eigen/LU>
#include <Eigen/SVD>
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/scene/energy.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/published.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

constexpr double young = 1e6, poisson = 0.3, yield_stress = 2e3;  // Pa
constexpr std::array<double, 2> hardenings = {0.0, 3e5};  // Pa
constexpr double mu = young / (2 * (1 + poisson)), bulk = young / (3 * (1 - 2 * poisson));

class Point {
 public:
  explicit Point(double hardening)
      : term_(component<Energy>(fmt::format("{{type: von_mises, young: {}, poisson: {}, yield_stress: {}, hardening: {}}}", young,
                                            poisson, yield_stress, hardening))
                  ->make_term(box().body, box().rest)) {}

  const Term& term() const { return *term_; }
  const History& history() const { return history_; }
  VecX at(const Mat3& f) const { return box().deformed(f); }
  double value(const Mat3& f) const { return term_->value(at(f)) / box().volume; }
  double dissipated(const Mat3& f) const { return Published(*term_).flow("dissipated_plastic", at(f)) / box().volume; }

  // First Piola-Kirchhoff: sum_v dE/dx_v X_v^T = V P.
  Mat3 piola(const Mat3& f) const {
    const VecX gradient = dense_gradient(*term_, at(f));
    Mat3 sum = Mat3::Zero();
    for (int v = 0; v < box().body.vertex_count; ++v)
      sum += Vec3(vertex(gradient, v)) * Vec3(vertex(box().rest, v)).transpose();
    return sum / box().volume;
  }
  Mat3 kirchhoff(const Mat3& f) const { return piola(f) * f.transpose(); }

  void step_to(const Mat3& f) {
    term_->commit(at(f), history_);
    term_->load_history(history_);
  }

  // A bar with free sides at the logarithmic strain e, by bisection on the strain across.
  Mat3 bar(double e) const {
    double low = -0.5, high = 0.5;
    const auto shape = [&](double side) -> Mat3 { return Vec3(std::exp(e), std::exp(side), std::exp(side)).asDiagonal(); };
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (kirchhoff(shape(middle))(1, 1) > 0 ? high : low) = middle;
    }
    return shape((low + high) / 2);
  }
  // Pulls the bar to a strain, in steps; returns its axial stress.
  double pull(double from, double to, int steps) {
    for (int i = 1; i <= steps; ++i) step_to(bar(from + (to - from) * i / steps));
    return kirchhoff(bar(to))(0, 0);
  }
  // The plastic deformation of the first tet.
  Mat3 plastic_inverse() const {
    return Eigen::Map<const Mat3>(history_.at("box/energies/0/plastic_inverse").values.data());
  }
  double plastic_strain() const { return Published(*term_).field("plastic_strain")(0); }

 private:
  static const TetBody& box() {
    static const TetBody b(Vec3(0.3, 0.2, 0.1), {1, 1, 1});
    return b;
  }

  std::unique_ptr<Term> term_;
  History history_;
};

Mat3 random_deformation(RandomMotions& random, double size) {
  Vec3 s;
  for (int i = 0; i < 3; ++i) s(i) = std::exp(random.uniform(-size, size));
  return random.rotation() * s.asDiagonal() * random.rotation().transpose();
}

// The return-mapped stress, from the equation of the yield surface by bisection on the flow.
Mat3 return_mapped_piola(const Mat3& f, const Mat3& plastic_inverse, double strain, double hardening) {
  const Mat3 trial = f * plastic_inverse;
  const Eigen::JacobiSVD<Mat3> svd(trial, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vec3 e = svd.singularValues().array().log();
  const Vec3 deviator = e.array() - e.mean();
  const double norm = deviator.norm();
  const auto excess = [&](double g) {  // of the stress beyond the yield surface after a flow g of the deviator's norm
    return 2 * mu * (norm - g) - std::sqrt(2.0 / 3) * (yield_stress + hardening * (strain + std::sqrt(2.0 / 3) * g));
  };
  double low = 0, high = norm;
  if (excess(0) <= 0) high = 0;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (excess(middle) > 0 ? low : high) = middle;
  }
  const Vec3 tau = (2 * mu * (1 - low / norm) * deviator).array() + bulk * e.sum();
  const Vec3 principal = tau.cwiseQuotient(svd.singularValues());
  return svd.matrixU() * principal.asDiagonal() * svd.matrixV().transpose() * plastic_inverse.transpose();
}

constexpr double yield_strain = yield_stress / young;

}  // namespace

TEST_CASE("von Mises: a bar in tension yields at its yield stress, flows, and unloads with E", "[von_mises]") {
  for (const double hardening : {0.0, young / 10, young}) {
    INFO("H = " << hardening);
    Point point(hardening);
    CHECK(point.pull(0, 0.999 * yield_strain, 1) == Approx(0.999 * yield_stress).epsilon(1e-9));
    CHECK(point.plastic_strain() == 0);
    const double tangent = young * hardening / (young + hardening);
    double from = 0.999 * yield_strain;
    for (const double e : {2 * yield_strain, 5 * yield_strain, 0.05, 0.3}) {
      CHECK(point.pull(from, e, 4) == Approx(yield_stress + tangent * (e - yield_strain)).epsilon(1e-6));
      from = e;
    }
    const double top = point.kirchhoff(point.bar(0.3))(0, 0);
    CHECK(point.plastic_strain() == Approx(0.3 - top / young).epsilon(1e-6));
    // Flow is isochoric: the change of volume is elastic.
    CHECK(std::log(point.bar(0.3).determinant()) == Approx((1 - 2 * poisson) * top / young).epsilon(1e-6));
    CHECK(point.plastic_inverse().determinant() == Approx(1).epsilon(1e-14));
    // Unloading to just before reverse yielding, and back.
    const double back = 1.9 * top / young;
    CHECK(point.pull(0.3, 0.3 - back, 3) == Approx(top - young * back).epsilon(1e-6));
    CHECK(point.pull(0.3 - back, 0.3, 3) == Approx(top).epsilon(1e-6));
    CHECK(point.plastic_strain() == Approx(0.3 - top / young).epsilon(1e-6));
    CHECK(point.pull(0.3, 0.3 - 2.5 * top / young, 3) == Approx(-top - tangent * 0.5 * top / young).epsilon(1e-6));
  }
}

TEST_CASE("von Mises: shear yields at sigma_y / sqrt(3)", "[von_mises]") {
  Point point(0);
  const auto pure = [](double g) -> Mat3 {  // logarithmic strain g / 2 along the diagonals
    Mat3 f = Mat3::Identity() * std::cosh(g / 2);
    f(0, 1) = f(1, 0) = std::sinh(g / 2);
    f(2, 2) = 1;
    return f;
  };
  const double yields = yield_stress / std::sqrt(3) / mu;
  CHECK(point.kirchhoff(pure(0.99 * yields))(0, 1) == Approx(0.99 * yield_stress / std::sqrt(3)).epsilon(1e-9));
  for (const double g : {1.5 * yields, 0.01, 0.2}) {
    point.step_to(pure(g));
    CHECK(point.kirchhoff(pure(g))(0, 1) == Approx(yield_stress / std::sqrt(3)).epsilon(1e-9));
  }
  // Simple shear turns the principal directions, by little here.
  Point simple(0);
  Mat3 f = Mat3::Identity();
  for (int i = 1; i <= 20; ++i) {
    f(0, 1) = 0.001 * i;
    simple.step_to(f);
  }
  CHECK(simple.kirchhoff(f)(0, 1) == Approx(yield_stress / std::sqrt(3)).epsilon(0.01));
}

TEST_CASE("von Mises: the stress in a step is the return-mapped one, also after the step is accepted", "[von_mises]") {
  RandomMotions random(5);
  for (const double hardening : hardenings) {
    Point point(hardening);
    point.step_to(random_deformation(random, 0.4));  // some plastic deformation to begin with
    int flows = 0;
    for (int trial = 0; trial < 40; ++trial) {
      Mat3 f = random_deformation(random, 0.5);
      // Also close to the yield surface, near the accepted state.
      if (trial % 2 == 1) f = (Mat3::Identity() + 2e-3 * random.uniform(0, 1) * random_deformation(random, 0.3)) * f;
      const Mat3 inverse = point.history().empty() ? Mat3(Mat3::Identity()) : point.plastic_inverse();
      const Mat3 expected = return_mapped_piola(f, inverse, point.plastic_strain(), hardening);
      const Mat3 found = point.piola(f);
      CHECK((found - expected).norm() <= 1e-10 * std::max(expected.norm(), bulk * 1e-2));
      const double before = point.value(f), dissipated = point.dissipated(f);
      flows += dissipated > 0;
      point.step_to(f);
      CHECK((point.piola(f) - found).norm() <= 1e-9 * std::max(found.norm(), bulk * 1e-2));
      CHECK(before - point.value(f) == Approx(dissipated).epsilon(1e-9).margin(1e-9 * before));
      const double kept = point.plastic_strain();
      CHECK(point.dissipated(f) == 0);  // no motion, no flow
      point.step_to(f);
      CHECK(point.plastic_strain() == kept);
    }
    CHECK(flows >= 10);
  }
}

TEST_CASE("von Mises: value, gradient and Hessian agree on both sides of the yield surface", "[von_mises]") {
  RandomMotions random(9);
  for (const double hardening : hardenings) {
    Point point(hardening);
    point.step_to(random_deformation(random, 0.3));
    const Mat3 unloaded = point.plastic_inverse().inverse();  // F = Fp: no stress
    const double limit = std::sqrt(1.5) * (yield_stress + hardening * point.plastic_strain()) / (3 * mu);  // of |dev e|
    for (const double reach : {0.2, 0.9, 1.1, 3.0, 30.0}) {
      INFO("H = " << hardening << ", " << reach << " of the yield surface");
      Vec3 e = random.vector();
      e.array() -= e.mean();
      e *= reach * limit / e.norm();
      const Vec3 s = (e.array() + random.uniform(-0.002, 0.002)).exp();
      const Mat3 turn = random.rotation();
      const VecX x = point.at(random.rotation() * s.asDiagonal() * turn.transpose() * unloaded);
      CHECK((Published(point.term()).flow("dissipated_plastic", x) > 0) == (reach > 1));
      const double step = 0.02 * limit * 0.1;  // m: stays on its side
      const MatX hessian = dense_hessian(point.term(), x, Projection::none);
      const VecX gradient = dense_gradient(point.term(), x);
      const double stiffness = hessian.cwiseAbs().maxCoeff();
      const VecX slopes = gradient_by_differences([&](const VecX& y) { return point.term().value(y); }, x, step);
      const MatX curvatures = hessian_by_differences([&](const VecX& y) { return dense_gradient(point.term(), y); }, x, step);
      CHECK((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-5 * stiffness * step + 1e-14 * point.term().value(x) / step);
      CHECK((curvatures - hessian).cwiseAbs().maxCoeff() <= 1e-6 * stiffness);
    }
  }
}

TEST_CASE("von Mises: no dissipation is negative, whatever the cycle", "[von_mises]") {
  RandomMotions random(2);
  for (const double hardening : hardenings) {
    Point point(hardening);
    double work = 0, strain = 0;
    Mat3 f = Mat3::Identity();
    for (int i = 0; i < 300; ++i) {
      f = (Mat3::Identity() + (i % 3 ? 1e-3 : 1e-2) * Mat3(Mat3::NullaryExpr([&] { return random.uniform(-1, 1); }))) * f;
      const double dissipated = point.dissipated(f);
      REQUIRE(dissipated >= 0);
      point.step_to(f);
      REQUIRE(point.plastic_strain() >= strain);
      strain = point.plastic_strain();
      work += dissipated;
    }
    CHECK(strain > 0.1);
    // Per volume sigma_y a + H a^2 / 2.
    CHECK(work == Approx(strain * (yield_stress + hardening * strain / 2)).epsilon(1e-9));
  }
}

TEST_CASE("von Mises: ten steps end where a thousand do", "[von_mises]") {
  const auto end = [](int steps) {
    Point point(1e5);
    Mat3 f;
    for (int i = 1; i <= steps; ++i) {  // tension that turns into shear
      const double t = 1.0 * i / steps;
      f = Mat3::Identity();
      f(0, 0) = 1 + 0.02 * t;
      f(0, 1) = 0.03 * t * t;
      point.step_to(f);
    }
    return std::pair(point.kirchhoff(f), point.plastic_strain());
  };
  const auto [few, strain_of_few] = end(10);
  const auto [many, strain_of_many] = end(1000);
  CHECK((few - many).norm() <= 0.01 * many.norm());
  CHECK(strain_of_few == Approx(strain_of_many).epsilon(0.01));
}

TEST_CASE("von Mises: a plastically deformed body rotates without stress", "[von_mises]") {
  Point point(1e5);
  Mat3 f = Mat3::Identity();
  f(0, 1) = 0.05;
  point.step_to(f);
  const Mat3 stress = point.kirchhoff(f);
  RandomMotions random(7);
  for (int i = 0; i < 5; ++i) {
    const Mat3 turn = random.rotation();
    CHECK(point.dissipated(turn * f) == 0);
    CHECK((point.kirchhoff(turn * f) - turn * stress * turn.transpose()).norm() <= 1e-9 * stress.norm());
  }
}

TEST_CASE("von Mises: two energies of an object have separate histories", "[von_mises]") {
  TetBody box(Vec3(0.1, 0.1, 0.1), {1, 1, 1});
  const auto energy = component<Energy>("{type: von_mises, young: 1e6, yield_stress: 1e3}");
  auto first = energy->make_term(box.body, box.rest);
  box.body.energy = 1;
  auto second = energy->make_term(box.body, box.rest);
  History history;
  first->commit(box.deformed(Vec3(1.1, 1, 1).asDiagonal()), history);
  second->commit(box.rest, history);
  CHECK(history.size() == 4);
  first->load_history(history);
  second->load_history(history);
  CHECK(Published(*first).field("plastic_strain")(0) > 0);
  CHECK(Published(*second).field("plastic_strain")(0) == 0);
}
