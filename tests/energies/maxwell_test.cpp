// Maxwell branches: relaxation, creep and moduli over frequency against closed forms of linear viscoelasticity, derivatives, dissipation.
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <fmt/format.h>

#include "framework/scene/energy.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/published.hpp"
#include "tests/support/sheet_body.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

constexpr double modulus = 2e4, relaxation_time = 0.3;  // Pa, s

// A box of tets of a branch alone, sheared or stretched as a whole.
class Branch {
 public:
  explicit Branch(Elements elements, const std::string& more = "")
      : box_(Vec3(0.3, 0.2, 0.1), {1, 1, 1}, elements),
        term_(component<Energy>(fmt::format("{{type: maxwell, modulus: {}, time: {}{}}}", modulus, relaxation_time, more))->make_term(box_.body, box_.rest)) {}

  VecX at(const Mat3& f) const {
    VecX x = box_.rest;
    for (int v = 0; v < x.size() / 3; ++v) vertex(x, v) = f * vertex(box_.rest, v);
    return x;
  }
  // Kirchhoff's stress, the mean over the box.
  Mat3 stress(const VecX& x) const {
    const VecX gradient = dense_gradient(*term_, x);
    Mat3 sum = Mat3::Zero();
    for (int v = 0; v < x.size() / 3; ++v) sum += gradient.segment<3>(3 * v) * vertex(x, v).transpose();
    return sum / box_.volume;
  }
  // A step h to the deformation f; returns the stress at its end.
  Mat3 step(const Mat3& f, double h) {
    const VecX x = at(f);
    term_->begin_step({before_.size() > 0 ? before_ : box_.rest, 0, h});
    const Mat3 in_step = stress(x);
    lost_ = Published(*term_).flow("dissipated_viscous", x) / box_.volume;
    term_->commit(x, history_);
    term_->load_history(history_);
    CHECK((stress(x) - in_step).norm() <= 1e-9 * in_step.norm() + 1e-9);  // after the step the stress is that of the stored energy
    before_ = x;
    return in_step;
  }
  double stored() const { return term_->value(before_) / box_.volume; }
  double lost() const { return lost_; }
  Term& term() { return *term_; }
  const VecX& rest() const { return box_.rest; }
  const VecX& before() const { return before_; }

 private:
  TetBody box_;
  std::unique_ptr<Term> term_;
  History history_;
  VecX before_;
  double lost_ = 0;
};

Mat3 shear(double gamma) {
  Mat3 f = Mat3::Identity();
  f(0, 1) = gamma;
  return f;
}
Mat3 stretch(double strain) {  // along x at constant volume
  return Vec3(std::exp(strain), std::exp(-strain / 2), std::exp(-strain / 2)).asDiagonal();
}
Mat3 random_deformation(double size) { return Mat3::Identity() + size * Mat3::Random(); }

const auto kinds = {Elements::linear, Elements::patches, Elements::composite};

}  // namespace

TEST_CASE("maxwell: a strain that is held relaxes exponentially, by any step and at any size", "[maxwell]") {
  for (const Elements kind : kinds)
    for (const double strain : {1e-6, 0.1, 1.0}) {
      Branch bar(kind);
      const double first = bar.step(stretch(strain), 1e-12)(0, 0);
      CHECK(first == Approx(2 * modulus * strain).epsilon(1e-8));
      double t = 0;
      for (const double h : {0.01, 0.2, 0.05, 1.0}) {
        t += h;
        CHECK(bar.step(stretch(strain), h)(0, 0) == Approx(first * std::exp(-t / relaxation_time)).epsilon(1e-8));
      }
    }
}

TEST_CASE("maxwell: a constant rate of strain has the stress of a dashpot, by any step", "[maxwell]") {
  const double rate = 0.02;
  for (const Elements kind : kinds) {
    Branch bar(kind);
    double t = 0, lost = 0;
    for (const double h : {0.01, 3.0, 0.2, 0.05, 40.0}) {
      t += h;
      CHECK(bar.step(stretch(rate * t), h)(0, 0) == Approx(2 * modulus * rate * relaxation_time * -std::expm1(-t / relaxation_time)).epsilon(1e-8));
      lost += bar.lost();
      // 3/2 of the strain along x in psi; the integral of 2 psi / time
      const double x = t / relaxation_time;
      CHECK(lost == Approx(3 * modulus * rate * rate * relaxation_time * relaxation_time * (x + 2 * std::expm1(-x) - std::expm1(-2 * x) / 2)).epsilon(1e-8));
    }
  }
}

TEST_CASE("maxwell: storage and loss modulus of three branches over three decades", "[maxwell]") {
  const std::vector<std::pair<double, double>> branches = {{1e4, 0.02}, {2e4, 0.3}, {5e3, 4}};  // Pa, s
  for (const double omega : {0.05, 0.5, 5.0, 50.0}) {
    std::vector<std::unique_ptr<Term>> terms;
    const TetBody box(Vec3(0.1, 0.1, 0.1), {1, 1, 1}, Elements::linear);
    for (size_t i = 0; i < branches.size(); ++i) {
      Body body = box.body;
      body.energy = static_cast<int>(i);
      terms.push_back(component<Energy>(fmt::format("{{type: maxwell, modulus: {}, time: {}}}", branches[i].first, branches[i].second))->make_term(body, box.rest));
    }
    std::complex<double> exact = 0, measured = 0;
    for (const auto& [g, tau] : branches) exact += g * std::complex<double>(0, omega * tau) / std::complex<double>(1, omega * tau);
    constexpr double amplitude = 1e-4;
    constexpr int steps = 300;  // of a period
    const int settling = static_cast<int>(std::ceil(6 * 4 * omega / (2 * 3.14159265))) + 1;
    const double h = 2 * 3.14159265358979 / omega / steps;
    History history;
    VecX before = box.rest;
    for (int i = 1; i <= (settling + 1) * steps; ++i) {
      const double phase = 2 * 3.14159265358979 * i / steps;
      VecX x = box.rest;
      for (int v = 0; v < x.size() / 3; ++v) vertex(x, v) = shear(amplitude * std::sin(phase)) * vertex(box.rest, v);
      double stress = 0;
      for (const auto& term : terms) {
        term->begin_step({before, 0, h});
        const VecX gradient = dense_gradient(*term, x);
        for (int v = 0; v < x.size() / 3; ++v) stress += gradient(3 * v) * vertex(box.rest, v).y() / box.volume;
        term->commit(x, history);
      }
      for (const auto& term : terms) term->load_history(history);
      if (i > settling * steps) measured += 2.0 / steps * stress / amplitude * std::complex<double>(std::sin(phase), std::cos(phase));
      before = x;
    }
    INFO("omega " << omega << ": " << measured.real() << " " << measured.imag() << ", " << exact.real() << " " << exact.imag());
    CHECK(std::abs(measured - exact) < 0.01 * std::abs(exact));
    CHECK(measured.real() == Approx(exact.real()).epsilon(0.01).margin(2e-3 * std::abs(exact)));
    CHECK(measured.imag() == Approx(exact.imag()).epsilon(0.01).margin(2e-3 * std::abs(exact)));
  }
}

TEST_CASE("maxwell: derivatives agree with differences within steps and between them", "[maxwell]") {
  std::srand(3);
  for (const Elements kind : kinds)
    for (const std::string more : {"", ", bulk: 5e4"}) {
      if (!more.empty() && kind != Elements::linear) continue;
      Branch bar(kind, more);
      for (int i = 0; i < 4; ++i) bar.step(random_deformation(0.2), 0.1);
      for (const double h : {0.0, 0.2}) {
        bar.term().begin_step({bar.before(), 0, h});
        VecX x = bar.at(random_deformation(0.2));
        x += 0.004 * VecX::Random(x.size());
        const VecX gradient = dense_gradient(bar.term(), x), by_differences = gradient_by_differences([&](const VecX& y) { return bar.term().value(y); }, x, 1e-5);
        CHECK((gradient - by_differences).norm() < 1e-8 * gradient.norm());
        const MatX hessian = dense_hessian(bar.term(), x, Projection::none);
        const MatX differences = hessian_by_differences([&](const VecX& y) { return dense_gradient(bar.term(), y); }, x, 1e-5);
        CHECK((hessian - differences).norm() < 1e-7 * hessian.norm());
        CHECK(smallest_eigenvalue(dense_hessian(bar.term(), x, Projection::clamp)) > -1e-9 * hessian.norm());
      }
    }
}

TEST_CASE("maxwell: what a cycle loses is the work that it takes", "[maxwell]") {
  for (const Elements kind : kinds) {
    std::vector<double> errors;
    for (const int steps : {40, 80}) {
      Branch bar(kind);
      double work = 0, lost = 0;
      Mat3 before = Mat3::Identity(), force = Mat3::Zero();
      for (int i = 1; i <= steps; ++i) {
        const Mat3 f = shear(0.5 * std::sin(2 * 3.14159265358979 * i / steps)) * stretch(0.2 * std::sin(3.14159265358979 * i / steps));
        const Mat3 next = bar.step(f, 2 * relaxation_time / steps) * f.inverse().transpose();
        work += (0.5 * (force + next)).cwiseProduct(f - before).sum();
        lost += bar.lost();
        CHECK(bar.lost() >= 0);
        before = f, force = next;
      }
      errors.push_back(std::abs(work - lost - bar.stored()) / lost);
    }
    INFO(errors[0] << " " << errors[1]);
    CHECK(errors[1] < 0.01);
    CHECK(errors[1] < 0.3 * errors[0]);
  }
}

TEST_CASE("maxwell: a rotation neither strains nor relaxes, and a rejected step leaves nothing", "[maxwell]") {
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  for (const Elements kind : kinds) {
    Branch held(kind), turned(kind);
    held.step(stretch(0.3) * shear(0.2), 0.1);
    turned.step(stretch(0.3) * shear(0.2), 0.1);
    turned.term().begin_step({turned.before(), 0, 0.4});  // rejected
    const Mat3 a = held.step(stretch(0.3) * shear(0.2), 0.2), b = turned.step(turn * stretch(0.3) * shear(0.2), 0.2);
    CHECK((turn * a * turn.transpose() - b).norm() < 1e-8 * a.norm());
  }
}

TEST_CASE("maxwell: a bulk modulus relaxes pressure, on linear tets alone", "[maxwell]") {
  Branch bar(Elements::linear, ", bulk: 5e4");
  const Mat3 grown = 1.05 * Mat3::Identity();
  const double first = bar.step(grown, 1e-12).trace() / 3;
  CHECK(first == Approx(5e4 * 3 * std::log(1.05)).epsilon(1e-8));
  CHECK(bar.step(grown, 0.2).trace() / 3 == Approx(first * std::exp(-0.2 / relaxation_time)).epsilon(1e-8));
  for (const Elements kind : {Elements::patches, Elements::composite}) CHECK_THROWS_WITH(Branch(kind, ", bulk: 5e4"), Catch::Contains("needs linear tets"));
}

TEST_CASE("maxwell_membrane: a sheet relaxes in its plane, with derivatives and the work that it loses", "[maxwell]") {
  const SheetBody sheet(Vec2(0.3, 0.2), {2, 2}, 1e-3);
  const double poisson = 0.3, lambda = 2 * modulus * poisson / (1 - poisson);
  const std::unique_ptr<Term> term = component<Energy>(fmt::format("{{type: maxwell_membrane, modulus: {}, poisson: {}, time: {}}}", modulus, poisson, relaxation_time))->make_term(sheet.body, sheet.rest);
  History history;
  VecX before = sheet.rest;
  const auto at = [&](double along, double across) {
    VecX x = sheet.rest;
    for (int v = 0; v < x.size() / 3; ++v) vertex(x, v) = Vec3(std::exp(along), std::exp(across), std::exp(across)).cwiseProduct(vertex(sheet.rest, v));
    return x;
  };
  const auto step = [&](const VecX& x, double h) {
    term->begin_step({before, 0, h});
    const VecX gradient = dense_gradient(*term, x);
    double stress = 0;
    for (int v = 0; v < x.size() / 3; ++v) stress += gradient(3 * v) * x(3 * v) / sheet.volume;
    term->commit(x, history);
    term->load_history(history);
    CHECK((dense_gradient(*term, x) - gradient).norm() <= 1e-9 * gradient.norm());
    before = x;
    return stress;
  };
  const double along = 0.2, across = -0.05, elastic = 2 * modulus * along + lambda * (along + across);
  CHECK(step(at(along, across), 1e-12) == Approx(elastic).epsilon(1e-8));
  CHECK(step(at(along, across), 0.1) == Approx(elastic * std::exp(-0.1 / relaxation_time)).epsilon(1e-8));
  CHECK(step(at(along, across), 2.0) == Approx(elastic * std::exp(-2.1 / relaxation_time)).epsilon(1e-8));

  // Derivatives within a step, at a deformation out of the plane.
  std::srand(5);
  term->begin_step({before, 0, 0.2});
  const VecX x = at(0.1, 0.05) + 0.005 * VecX::Random(sheet.rest.size());
  const VecX gradient = dense_gradient(*term, x);
  CHECK((gradient - gradient_by_differences([&](const VecX& y) { return term->value(y); }, x, 1e-5)).norm() < 1e-8 * gradient.norm());
  const MatX hessian = dense_hessian(*term, x, Projection::none);
  CHECK((hessian - hessian_by_differences([&](const VecX& y) { return dense_gradient(*term, y); }, x, 1e-5)).norm() < 1e-7 * hessian.norm());
  CHECK(smallest_eigenvalue(dense_hessian(*term, x, Projection::clamp)) > -1e-9 * hessian.norm());

  // A constant rate: the stress of a dashpot and its loss.
  history.clear(), term->load_history({}), before = sheet.rest;
  double t = 0, lost = 0;
  constexpr double rate = 0.02;
  for (const double h : {0.05, 1.0, 20.0}) {
    t += h;
    term->begin_step({before, 0, h});
    lost += Published(*term).flow("dissipated_viscous", at(rate * t, 0)) / sheet.volume;
    CHECK(step(at(rate * t, 0), h) == Approx((2 * modulus + lambda) * rate * relaxation_time * -std::expm1(-t / relaxation_time)).epsilon(1e-8));
    const double s = t / relaxation_time;
    CHECK(lost == Approx((2 * modulus + lambda) * rate * rate * relaxation_time * relaxation_time * (s + 2 * std::expm1(-s) - std::expm1(-2 * s) / 2)).epsilon(1e-8));
  }
}
