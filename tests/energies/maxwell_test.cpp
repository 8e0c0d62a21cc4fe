// Maxwell branches: relaxation, creep and moduli over frequency against closed forms of linear viscoelasticity, derivatives, dissipation, temperature.
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <fmt/format.h>

#include "framework/bond/environment.hpp"
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

TEST_CASE("maxwell: a fraction is that of the energy beside it", "[maxwell]") {
  std::vector<std::unique_ptr<Energy>> beside;
  beside.push_back(component<Energy>("{type: neo_hookean, young: 26 kPa, poisson: 0.3}"));  // G = 10 kPa, K = 65/3 kPa
  TetBody box(Vec3(0.3, 0.2, 0.1), {1, 1, 1});
  const auto gradient = [&](const std::string& yaml) {
    const auto term = component<Energy>(yaml)->make_term(box.body, box.rest);
    return VecX(dense_gradient(*term, box.deformed(stretch(0.2) * shear(0.1) * 1.1)));
  };
  CHECK_THROWS_WITH(gradient("{type: maxwell, fraction: 2, time: 1}"), Catch::Contains("none of its energies have one; give `modulus`"));
  box.body.energies = beside;
  const VecX given = gradient("{type: maxwell, modulus: 20 kPa, bulk: 65 kPa, time: 1}");
  CHECK((gradient("{type: maxwell, fraction: 2, bulk_fraction: 3, time: 1}") - given).norm() <= 1e-12 * given.norm());
  beside.push_back(component<Energy>("{type: gent, shear_modulus: 1 kPa, j_m: 10}"));
  box.body.energies = beside;
  CHECK_THROWS_WITH(gradient("{type: maxwell, fraction: 2, time: 1}"), Catch::Contains("2 of its energies have one"));
  CHECK_THROWS_WITH(component<Energy>("{type: maxwell, time: 1}"), Catch::Contains("give one of the two"));
  CHECK_THROWS_WITH(component<Energy>("{type: maxwell, modulus: 1 Pa, fraction: 1, time: 1}"), Catch::Contains("give one of the two"));
  CHECK_THROWS_WITH(component<Energy>("{type: maxwell, modulus: 1 Pa, bulk: 1 Pa, bulk_fraction: 1, time: 1}"), Catch::Contains("give one of the two"));
  CHECK_THROWS_WITH(component<Energy>("{type: maxwell, modulus: 1 Pa, time: 1, shift: arrhenius}"), Catch::Contains("activation_energy"));
}

TEST_CASE("maxwell: the temperature shifts the time of each element", "[maxwell]") {
  const std::string arrhenius = ", shift: arrhenius, activation_energy: 60 kJ/mol, reference_temperature: 300", wlf = ", shift: wlf, wlf_c1: 8.86, wlf_c2: 101.6, reference_temperature: 300";
  const auto factor = [&](const std::string& shift, double kelvin) {
    return shift == wlf ? std::pow(10, -8.86 * (kelvin - 300) / (101.6 + kelvin - 300)) : std::exp(60e3 / 8.31446261815324 * (1 / kelvin - 1 / 300.0));
  };
  for (const std::string& shift : {arrhenius, wlf})
    for (const bool profile : {false, true}) {
      // Between 290 and 310 K along the body; everywhere 10 K more at each 0.4 s.
      Environment environment;
      bind(parse_string(profile ? "{temperature: 300, profile: (x - 0.15) * 66 + 25 * t}" : "{temperature: [[0, 300], [10, 550]]}", "test.yaml"), environment, "environment");
      const auto check = [&](Body& body, const VecX& rest, const std::string& yaml, const auto& elements) {
        INFO(yaml << shift);
        body.environment = &environment;
        const auto term = component<Energy>(yaml + shift + "}")->make_term(body, rest);
        CHECK(component<Energy>(yaml + shift + "}")->depends_on_temperature());
        VecX x = rest;
        for (int v = 0; v < x.size() / 3; ++v) vertex(x, v) = stretch(0.1) * vertex(rest, v);
        // The energies of elements at once, and their sum after each step.
        std::vector<double> energies, times;
        term->begin_step({rest, 0, 1e-12});
        History history;
        term->commit(x, history);
        term->load_history(history);
        const double first = term->value(x);
        double t = 0;
        std::vector<double> reduced(elements.size(), 0.0);
        for (const double h : {0.1, 0.3, 0.02}) {
          term->begin_step({x, t, h});
          double expected = 0, all = 0;
          for (size_t e = 0; e < elements.size(); ++e) {
            const auto& [volume, centre] = elements[e];
            reduced[e] += h / (relaxation_time * factor(shift, environment.temperature(t + h / 2, centre)));
            expected += volume * std::exp(-2 * reduced[e]);
            all += volume;
          }
          const double before = term->value(x), lost = Published(*term).flow("dissipated_viscous", x);
          CHECK(dense_gradient(*term, x).norm() > 0);
          CHECK((dense_gradient(*term, x) - gradient_by_differences([&](const VecX& y) { return term->value(y); }, x, 1e-5)).norm() < 1e-7 * dense_gradient(*term, x).norm());
          const double stored = [&] {
            term->begin_step({x, t, 0});
            return term->value(x);
          }();
          term->begin_step({x, t, h});
          CHECK(term->value(x) == before);  // a step that is tried again
          term->commit(x, history);
          term->load_history(history);
          t += h;
          CHECK(term->value(x) == Approx(first * expected / all).epsilon(1e-8));
          CHECK(stored - term->value(x) == Approx(lost).epsilon(1e-6));
        }
      };
      using Element = std::pair<double, Vec3>;
      for (const Elements kind : kinds) {
        TetBody box(Vec3(0.3, 0.2, 0.1), {2, 1, 1}, kind);
        std::vector<Element> elements;
        const int per = kind == Elements::composite ? 8 : 1;
        for (size_t t = 0; t < box.body.tets.size(); t += per) {
          double volume = 0;
          Vec3 centre = Vec3::Zero();
          for (int k = 0; k < per; ++k) {
            const Tet& tet = box.body.tets[t + k];
            Mat3 edges;
            for (int a = 0; a < 3; ++a) edges.col(a) = vertex(box.rest, tet[a + 1]) - vertex(box.rest, tet[0]);
            volume += edges.determinant() / 6;
            for (const int v : tet) centre += vertex(box.rest, v) / (4 * per);
          }
          elements.emplace_back(volume, centre);
        }
        check(box.body, box.rest, fmt::format("{{type: maxwell, modulus: 2e4, time: {}", relaxation_time), elements);
      }
      SheetBody sheet(Vec2(0.3, 0.2), {3, 2}, 1e-3);
      std::vector<Element> elements;
      for (const Triangle& t : sheet.body.sheet) {
        const Vec3 a = vertex(sheet.rest, t[0]), b = vertex(sheet.rest, t[1]), c = vertex(sheet.rest, t[2]);
        elements.emplace_back((b - a).cross(c - a).norm(), (a + b + c) / 3);
      }
      check(sheet.body, sheet.rest, fmt::format("{{type: maxwell_membrane, modulus: 2e4, time: {}", relaxation_time), elements);
    }
}
