// Flow that takes time (viscosity of von_mises and von_mises_membrane), of bars and strips with free sides and of random deformations, against
// closed forms: the stress is sigma_y + H a + eta da/dt.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/scene/energy.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/published.hpp"
#include "tests/support/sheet_body.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

constexpr double young = 1e6, poisson = 0.3, yield_stress = 2e3;  // Pa
constexpr double viscosity = 4e3;  // Pa s

std::string with(const std::string& type, double hardening, const std::string& more) {
  return fmt::format("{{type: {}, young: {}, poisson: {}, yield_stress: {}, hardening: {}{}}}", type, young, poisson, yield_stress, hardening, more);
}
const std::string viscous = fmt::format(", viscosity: {}", viscosity);

// A box of tets, or a sheet, pulled along x.
class Specimen {
 public:
  Specimen(const std::string& kind, double hardening, const std::string& more = viscous) {
    if (kind == "membrane") {
      const SheetBody sheet(Vec2(0.3, 0.2), {2, 2}, 1e-3);
      rest_ = sheet.rest, volume_ = sheet.volume;
      term_ = component<Energy>(with("von_mises_membrane", hardening, more))->make_term(sheet.body, rest_);
    } else {
      const TetBody box(Vec3(0.3, 0.2, 0.1), {1, 1, 1}, kind == "composite" ? Elements::composite : kind == "patches" ? Elements::patches : Elements::linear);
      rest_ = box.rest, volume_ = box.volume;
      term_ = component<Energy>(with("von_mises", hardening, more))->make_term(box.body, rest_);
    }
  }

  Term& term() { return *term_; }
  const VecX& rest() const { return rest_; }
  VecX at(double along, double across) const {
    VecX x = rest_;
    for (int v = 0; v < x.size() / 3; ++v)
      vertex(x, v) = Vec3(std::exp(along), std::exp(across), std::exp(across)).cwiseProduct(vertex(rest_, v));
    return x;
  }
  // Kirchhoff's, along the axis i.
  double stress(const VecX& x, int i) const {
    const VecX gradient = dense_gradient(*term_, x);
    double sum = 0;
    for (int v = 0; v < x.size() / 3; ++v) sum += gradient(3 * v + i) * x(3 * v + i);
    return sum / volume_;
  }
  // A bar with free sides at a logarithmic strain.
  VecX free_sides(double along) const {
    double low = -0.5, high = 0.5;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (stress(at(along, middle), 2) > 0 ? high : low) = middle;
    }
    return at(along, (low + high) / 2);
  }
  void begin(double h) { term_->begin_step({rest_, 0, h}); }
  void keep(const VecX& x) {
    term_->commit(x, history_);
    term_->load_history(history_);
  }
  // A step to a strain; returns the stress at its end.
  double step(double along, double h) {
    begin(h);
    const VecX x = free_sides(along);
    const double in_step = stress(x, 0);
    keep(x);
    CHECK(stress(x, 0) == Approx(in_step).epsilon(1e-8));  // the value after the step is the stored energy, beyond the yield surface too
    return in_step;
  }
  double value(const VecX& x) const { return term_->value(x) / volume_; }
  double flow(const std::string& column, const VecX& x) const { return Published(*term_).flow(column, x) / volume_; }
  double plastic_strain() const { return Published(*term_).field("plastic_strain")(0); }

 private:
  VecX rest_;
  double volume_ = 0;
  std::unique_ptr<Term> term_;
  History history_;
};

const std::vector<std::string> kinds = {"linear", "composite", "patches", "membrane"};

}  // namespace

TEST_CASE("viscoplastic: at a constant rate the stress is above the yield stress by the viscosity times the rate", "[von_mises]") {
  for (const std::string& kind : kinds)
    for (const double rate : {0.1, 1.0}) {
      INFO(kind << ", " << rate << "/s");
      Specimen bar(kind, 0);
      const double last = 5 * viscosity / young + 2 * yield_stress / young / rate, h = last / 50;  // several relaxation times
      double stress = 0;
      for (int i = 1; i <= 50; ++i) stress = bar.step(rate * h * i, h);
      CHECK(stress - yield_stress == Approx(viscosity * rate).epsilon(0.01));
      // With hardening, for any step size.
      Specimen hard(kind, 1e5);
      double before = 0;
      for (int i = 1; i <= 10; ++i) {
        before = hard.plastic_strain();
        stress = hard.step(10 * rate * h * i, 10 * h);
      }
      const double a = hard.plastic_strain();
      CHECK(stress == Approx(yield_stress + 1e5 * a + viscosity * (a - before) / (10 * h)).epsilon(1e-6));
    }
}

TEST_CASE("viscoplastic: a bar of constant length relaxes to its yield stress, in eta / E", "[von_mises]") {
  for (const std::string& kind : kinds) {
    INFO(kind);
    Specimen bar(kind, 0);
    constexpr double held = 3 * yield_stress / young, h = 0.05 * viscosity / young;
    double before = bar.step(held, 1e-9 * h);  // so fast that it is elastic
    CHECK(before == Approx(3 * yield_stress).epsilon(1e-6));
    for (int i = 0; i < 60; ++i) {
      const double stress = bar.step(held, h);
      CHECK((stress - yield_stress) / (before - yield_stress) == Approx(1 / (1 + young * h / viscosity)).epsilon(1e-5));
      before = stress;
    }
    CHECK((before - yield_stress) / (2 * yield_stress) == Approx(std::exp(-60 * 0.05)).epsilon(0.1));
  }
}

TEST_CASE("viscoplastic: the potential of a step is stored energy, plastic work and half of the viscous dissipation", "[von_mises]") {
  for (const std::string& kind : kinds)
    for (const double hardening : {0.0, 3e5}) {
      INFO(kind << ", H = " << hardening);
      Specimen bar(kind, hardening);
      double lost = 0;
      for (int i = 1; i <= 20; ++i) {
        bar.begin(0.01);
        const VecX x = bar.at(0.002 * i * (i % 4 == 3 ? 0.5 : 1), -0.0008 * i);
        const double before = bar.value(x), plastic = bar.flow("dissipated_plastic", x), rate = bar.flow("dissipated_viscous", x), a = bar.plastic_strain();
        bar.keep(x);
        CHECK(before - bar.value(x) == Approx(plastic + rate / 2).epsilon(1e-8).margin(1e-9 * before));
        if (kind != "patches" && kind != "composite") {
          const double added = bar.plastic_strain() - a;
          CHECK(rate == Approx(viscosity * added * added / 0.01).epsilon(1e-6).margin(1e-12));
        }
        // Between steps nothing flows.
        CHECK(bar.flow("dissipated_plastic", x) == 0);
        CHECK(bar.flow("dissipated_viscous", x) == 0);
        lost += rate;
      }
      CHECK(lost > 0);
    }
}

TEST_CASE("viscoplastic: value, gradient and Hessian agree on both sides of the yield surface", "[von_mises]") {
  RandomMotions random(3);
  for (const std::string& kind : kinds) {
    Specimen bar(kind, 1e5);
    bar.begin(0.01);
    bar.keep(bar.free_sides(0.05));
    for (const double h : {1e-4, 0.01, 10.0}) {
      INFO(kind << ", h = " << h);
      bar.begin(h);
      const VecX x = bar.free_sides(0.08) + 1e-4 * random.vectors(bar.rest().size());
      CHECK(bar.flow("dissipated_plastic", x) > 0);
      constexpr double step = 1e-7;  // m
      const MatX hessian = dense_hessian(bar.term(), x, Projection::none);
      const VecX gradient = dense_gradient(bar.term(), x);
      const double stiffness = hessian.cwiseAbs().maxCoeff();
      const VecX slopes = gradient_by_differences([&](const VecX& y) { return bar.term().value(y); }, x, step);
      const MatX curvatures = hessian_by_differences([&](const VecX& y) { return dense_gradient(bar.term(), y); }, x, step);
      CHECK((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-5 * gradient.lpNorm<Eigen::Infinity>() + 1e-2 * stiffness * step);
      CHECK((curvatures - hessian).cwiseAbs().maxCoeff() <= 1e-5 * stiffness);
    }
  }
}

TEST_CASE("viscoplastic: slow flow is inviscid, and a viscosity of zero gives the bits of none", "[von_mises]") {
  for (const std::string& kind : kinds) {
    INFO(kind);
    Specimen none(kind, 1e5, ""), zero(kind, 1e5, ", viscosity: 0"), slow(kind, 1e5);
    for (int i = 1; i <= 5; ++i) {
      for (Specimen* s : {&none, &zero, &slow}) s->begin(s == &slow ? 1e9 : 0.01);
      const VecX x = none.free_sides(0.01 * i);
      CHECK(zero.term().value(x) == none.term().value(x));
      CHECK(dense_gradient(zero.term(), x) == dense_gradient(none.term(), x));
      CHECK(slow.stress(x, 0) == Approx(none.stress(x, 0)).epsilon(1e-6));
      for (Specimen* s : {&none, &zero, &slow}) s->keep(x);
    }
  }
}
