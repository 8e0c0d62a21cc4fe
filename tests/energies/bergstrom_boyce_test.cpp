// The network of Bergstrom and Boyce against closed forms and against an ordinary differential equation that is integrated here: relaxation, creep, loops;
// its potential, derivatives, dissipation, temperature; and against Maxwell branches.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>
#include <functional>

#include "energies/viscoelastic/network_flow.hpp"
#include "framework/bond/environment.hpp"
#include "framework/scene/energy.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/published.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

constexpr double mu = 2e4, flow_stress = 6e3, flow_rate = 0.2;  // Pa, Pa, 1/s

std::string network(double exponent, const std::string& more = "") {
  return fmt::format("{{type: bergstrom_boyce, modulus: {}, flow_stress: {}, flow_rate: {}, exponent: {}{}}}", mu, flow_stress, flow_rate, exponent, more);
}

// A box of tets of a network (or another energy) alone, deformed as a whole.
class Bar {
 public:
  explicit Bar(Elements elements, const std::string& yaml) : box_(Vec3(0.3, 0.2, 0.1), {1, 1, 1}, elements), term_(component<Energy>(yaml)->make_term(box_.body, box_.rest)) {}

  VecX at(const Mat3& f) const { return box_.deformed(f); }
  // Kirchhoff's stress, the mean over the box.
  Mat3 stress(const VecX& x) const {
    const VecX gradient = dense_gradient(*term_, x);
    Mat3 sum = Mat3::Zero();
    for (int v = 0; v < x.size() / 3; ++v) sum += gradient.segment<3>(3 * v) * vertex(x, v).transpose();
    return sum / box_.volume;
  }
  // The stress of a step h to the deformation f that is tried alone.
  Mat3 tried(const Mat3& f, double h) {
    term_->begin_step({before_, 0, h});
    return stress(at(f));
  }
  // A step h to the deformation f; returns the stress at its end.
  Mat3 step(const Mat3& f, double h) {
    const VecX x = at(f);
    const Mat3 in_step = tried(f, h);
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
  const VecX& before() const { return before_; }

 private:
  TetBody box_;
  std::unique_ptr<Term> term_;
  History history_;
  VecX before_ = box_.rest;
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
double tension(const Mat3& kirchhoff) { return kirchhoff(0, 0) - kirchhoff(1, 1); }

// A bar in tension: the viscous strain v at the total logarithmic strain e(t), by the classical Runge-Kutta method. Returns v at the end.
struct Tension {
  double exponent, chain_exponent = 0, chain_offset = 0.01;

  double stress(double e, double v) const { return 3 * mu * (e - v); }
  double rate(double e, double v) const {
    const double sigma = stress(e, v), chain = std::sqrt((std::exp(2 * v) + 2 * std::exp(-v)) / 3);
    return std::copysign(flow_rate * std::pow(chain - 1 + chain_offset, chain_exponent) * std::pow(std::abs(sigma) / flow_stress, exponent), sigma);
  }
  double flow(double v, double start, double end, int steps, const std::function<double(double)>& e) const {
    const double h = (end - start) / steps;
    for (int i = 0; i < steps; ++i) {
      const double t = start + i * h;
      const double k1 = rate(e(t), v), k2 = rate(e(t + h / 2), v + h / 2 * k1), k3 = rate(e(t + h / 2), v + h / 2 * k2), k4 = rate(e(t + h), v + h * k3);
      v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return v;
  }
};

const auto kinds = {Elements::linear, Elements::patches, Elements::composite};

}  // namespace

TEST_CASE("bergstrom_boyce: the fractions of a step solve its equation for any strain, step and exponent", "[bergstrom_boyce]") {
  for (const double exponent : {1.0, 1.5, 2.0, 4.0, 7.3, 30.0}) {
    const NetworkFlow flow{mu, 0.1, 1, exponent};
    CHECK(flow.fractions(0.3, -std::numeric_limits<double>::infinity()).left == 1);
    CHECK(flow.fractions(0.0, 2.0).left == Approx(exponent == 1 ? 1 / (1 + std::exp(2.0)) : 1.0));
    for (const double trial : {1e-12, 1e-3, 0.1, 0.5, 4.0})
      for (const double log_k : {-60.0, -8.0, -1.0, 0.0, 0.7, 5.0, 40.0, 200.0}) {
        CAPTURE(exponent, trial, log_k);
        const NetworkFlow::Fractions<double> f = flow.fractions(trial, log_k);
        const double log_q = log_k + (exponent - 1) * std::log(trial / 0.1);
        CHECK(f.left + f.flowed == Approx(1).epsilon(1e-13));
        // The same of packs, whatever is in the other lanes.
        Pack trials = 0.37, logs = 1.3;
        trials.set(1, trial), logs.set(1, log_k);
        const NetworkFlow::Fractions<Pack> packed = flow.fractions(trials, logs), alone = flow.fractions(Pack(trial), Pack(log_k));
        CHECK(packed.left[1] == alone.left[0]);
        CHECK(packed.flowed[1] == alone.flowed[0]);
        CHECK(packed.left[1] == Approx(f.left).epsilon(1e-12));
        CHECK(packed.flowed[1] == Approx(f.flowed).epsilon(1e-12).margin(1e-300));
        if (f.flowed > 1e-290) CHECK(log_q + exponent * std::log(f.left) == Approx(std::log(f.flowed)).epsilon(1e-12).margin(f.flowed < 1e-8 ? 1e-6 : 1e-12 * exponent));
        // The slope of the potential, and that of the slope.
        const auto strain = [&](double n) { return n * flow.fractions(n, log_k).left; };
        const auto energy = [&](double n) { return n * n * flow.potential(flow.fractions(n, log_k)); };
        CHECK(central_difference([&](double d) { return energy(trial * (1 + d)); }, 1e-3) == Approx(2 * trial * strain(trial)).epsilon(1e-6));
        CHECK(central_difference([&](double d) { return strain(trial * (1 + d)); }, 1e-3) == Approx(trial * flow.tangent(f)).epsilon(1e-6));
      }
  }
}

TEST_CASE("bergstrom_boyce: a strain that is held relaxes by the power of its stress, in first order of the step", "[bergstrom_boyce]") {
  const double strain = 0.3, end = 1;
  for (const Elements kind : kinds)
    for (const double exponent : {1.0, 2.0, 4.0, 8.0}) {
      // d sigma/dt = -3 mu d_0 (sigma / sigma_0)^m
      const double first = 3 * mu * strain, slope = 3 * mu * flow_rate / flow_stress;
      const auto exact = [&](double t) {
        if (exponent == 1) return first * std::exp(-slope * t);
        return flow_stress * std::pow(std::pow(first / flow_stress, 1 - exponent) + (exponent - 1) * slope * t, 1 / (1 - exponent));
      };
      std::vector<double> errors;
      for (const int steps : {100, 200, 400}) {
        Bar bar(kind, network(exponent));
        CHECK(tension(bar.step(stretch(strain), 1e-13)) == Approx(first).epsilon(1e-6));
        double worst = 0, lost = 0;
        const double stored = bar.stored();
        for (int i = 1; i <= steps; ++i) {
          const double sigma = tension(bar.step(stretch(strain), end / steps));
          lost += bar.lost();
          if (2 * i >= steps) worst = std::max(worst, std::abs(sigma / exact(end * i / steps) - 1));
        }
        CHECK(lost == Approx(stored - bar.stored()).epsilon(1e-9));
        errors.push_back(worst);
      }
      INFO("m " << exponent << ", errors " << errors[0] << " " << errors[1] << " " << errors[2]);
      CHECK(errors[1] < 0.6 * errors[0]);
      CHECK(errors[2] < 0.6 * errors[1]);
      CHECK(errors[2] > 0.4 * errors[1]);
      CHECK(errors[2] < 0.01);
    }
}

TEST_CASE("bergstrom_boyce: under a constant stress the rate of creep is the power of the stress", "[bergstrom_boyce]") {
  for (const Elements kind : kinds)
    for (const double exponent : {1.0, 3.0, 5.0}) {
      std::vector<double> rates;
      for (const double stress : {2e3, 4e3, 8e3}) {
        Bar bar(kind, network(exponent));
        const double h = 1e-2;
        double strain = 0, before = 0;
        for (int i = 0; i < 20; ++i) {
          before = strain;
          double low = strain - 1, high = strain + 1;
          for (int k = 0; k < 60; ++k) (tension(bar.tried(stretch((low + high) / 2), h)) < stress ? low : high) = (low + high) / 2;
          bar.step(stretch(strain = (low + high) / 2), h);
        }
        rates.push_back((strain - before) / h);
        CHECK(rates.back() == Approx(flow_rate * std::pow(stress / flow_stress, exponent)).epsilon(1e-6));
      }
      for (int i = 0; i < 2; ++i) CHECK(std::log2(rates[i + 1] / rates[i]) == Approx(exponent).epsilon(1e-6));
    }
}

TEST_CASE("bergstrom_boyce: loops of the stress agree with the differential equation over three decades of the rate", "[bergstrom_boyce]") {
  const double amplitude = 0.4;
  constexpr int steps = 800;  // of a cycle
  for (const double chain_exponent : {0.0, -0.7})
    for (const double strain_rate : {0.02, 0.2, 2.0, 20.0}) {
      // Triangles from 0 to the amplitude and back; the second cycle counts.
      const double period = 2 * amplitude / strain_rate;
      const auto strain = [&](double t) {
        const double phase = std::fmod(t, period) / period;
        return 2 * amplitude * std::min(phase, 1 - phase);
      };
      Bar bar(Elements::linear, network(4, fmt::format(", strain_exponent: {}", chain_exponent)));
      const Tension ode{4, chain_exponent};
      double area = 0, exact = 0, lost = 0, stored = 0, sigma = 0, v = 0, sigma_exact = 0, peak = 0, peak_exact = 0;
      for (int i = 1; i <= 2 * steps; ++i) {
        const double start = period * (i - 1) / steps, end = i % steps == 0 ? start + period / steps : period * i / steps;
        const double e = i % steps == 0 ? 0 : strain(end), de = e - (i % steps == 1 ? 0 : strain(start));
        const double next = tension(bar.step(stretch(e), period / steps));
        v = ode.flow(v, start, end, 200, [&](double t) { return t >= end && i % steps == 0 ? 0 : strain(t); });
        const double next_exact = ode.stress(e, v);
        if (i > steps) {
          area += (sigma + next) / 2 * de, exact += (sigma_exact + next_exact) / 2 * de, lost += bar.lost();
          peak = std::max(peak, next), peak_exact = std::max(peak_exact, next_exact);
        }
        if (i == steps) stored = bar.stored();
        CHECK(bar.lost() >= 0);
        sigma = next, sigma_exact = next_exact;
      }
      INFO("rate " << strain_rate << ", C " << chain_exponent << ": area " << area << ", exact " << exact << ", lost " << lost << ", peak " << peak << " " << peak_exact);
      CHECK(area == Approx(exact).epsilon(0.01));
      CHECK(peak == Approx(peak_exact).epsilon(0.01));
      CHECK(lost + bar.stored() - stored == Approx(area).epsilon(0.01));
    }
}

TEST_CASE("bergstrom_boyce: with the exponent 1 it is a Maxwell branch", "[bergstrom_boyce]") {
  const double time = flow_stress / (3 * mu * flow_rate);
  for (const Elements kind : kinds) {
    // The recurrence of backward Euler for coaxial strains: e_(n+1) = (e_n + change) / (1 + h / time).
    Bar bar(kind, network(1));
    double elastic = 0, before = 0;
    for (const auto& [strain, h] : std::vector<std::pair<double, double>>{{0.2, 0.1}, {0.7, 0.03}, {-0.3, 2.0}, {-0.2, 0.2}}) {
      elastic = (elastic + strain - before) / (1 + h / time), before = strain;
      CHECK(tension(bar.step(stretch(strain), h)) == Approx(3 * mu * elastic).epsilon(1e-9));
    }
    // The component `maxwell` along an arbitrary path, small and large: it differs by the order of the step alone.
    for (const double size : {1e-4, 0.5}) {
      std::vector<double> errors;
      for (const int steps : {50, 100}) {
        Bar own(kind, network(1)), other(kind, fmt::format("{{type: maxwell, modulus: {}, time: {}}}", mu, time));
        double worst = 0, largest = 0;
        for (int i = 1; i <= steps; ++i) {
          const double t = 3.0 * i / steps;
          const Mat3 f = shear(size * std::sin(2 * t)) * stretch(size * std::sin(t));
          const Mat3 a = own.step(f, 3 * time / steps), b = other.step(f, 3 * time / steps);
          worst = std::max(worst, (a - b).norm()), largest = std::max(largest, b.norm());
        }
        errors.push_back(worst / largest);
      }
      INFO("size " << size << ", differences " << errors[0] << " " << errors[1]);
      CHECK(errors[1] < 0.02);
      CHECK(errors[1] == Approx(errors[0] / 2).epsilon(0.1));
    }
  }
}

TEST_CASE("bergstrom_boyce: derivatives agree with differences within steps and between them", "[bergstrom_boyce]") {
  std::srand(3);
  for (const Elements kind : kinds)
    for (const double exponent : {1.0, 2.0, 4.0, 9.0}) {
      Bar bar(kind, network(exponent, ", strain_exponent: -0.7"));
      for (int i = 0; i < 4; ++i) bar.step(random_deformation(0.2), 0.1);
      bool flowed = false;
      for (const double h : {0.0, 1e-3, 0.2, 50.0}) {
        bar.term().begin_step({bar.before(), 0, h});
        VecX x = bar.at(random_deformation(0.2));
        x += 0.004 * VecX::Random(x.size());
        CAPTURE(exponent, h);
        const VecX gradient = dense_gradient(bar.term(), x), by_differences = gradient_by_differences([&](const VecX& y) { return bar.term().value(y); }, x, 1e-5);
        CHECK((gradient - by_differences).norm() < 1e-7 * gradient.norm());
        const MatX hessian = dense_hessian(bar.term(), x, Projection::none);
        const MatX differences = hessian_by_differences([&](const VecX& y) { return dense_gradient(bar.term(), y); }, x, 1e-5);
        CHECK((hessian - differences).norm() < 1e-6 * hessian.norm());
        for_each_stencil_hessian(bar.term(), x, Projection::clamp, [&](const MatX& k, const int*) { CHECK(smallest_eigenvalue(k) > -1e-12 * k.cwiseAbs().maxCoeff()); });
        flowed = flowed || Published(bar.term()).flow("dissipated_viscous", x) > 0;
      }
      CHECK(flowed);
    }
}

TEST_CASE("bergstrom_boyce: derivatives agree with differences at equal principal stretches within a step", "[bergstrom_boyce]") {
  for (const Elements kind : kinds)
    for (const Vec3& s : {Vec3(1, 1, 1), Vec3(1.4, 1.4, 1.4), Vec3(1.5, 1.5, 0.7), Vec3(0.6, 1.2, 0.6), Vec3(1.2, 1.2 + 1e-9, 0.9), Vec3(0.15, 0.2, 0.25)}) {
      Bar bar(kind, network(4));
      bar.term().begin_step({bar.before(), 0, 0.3});
      const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
      const VecX x = bar.at(turn * s.asDiagonal() * turn.transpose());
      INFO(s.transpose());
      const double stiffness = dense_hessian(bar.term(), x, Projection::none).norm();
      const VecX gradient = dense_gradient(bar.term(), x), by_differences = gradient_by_differences([&](const VecX& y) { return bar.term().value(y); }, x, 1e-5);
      CHECK((gradient - by_differences).norm() < 1e-6 * stiffness * 1e-3);
      const MatX differences = hessian_by_differences([&](const VecX& y) { return dense_gradient(bar.term(), y); }, x, 1e-5);
      CHECK((dense_hessian(bar.term(), x, Projection::none) - differences).norm() < 1e-6 * stiffness);
    }
}

TEST_CASE("bergstrom_boyce: what a path loses is the work that it takes, and never negative", "[bergstrom_boyce]") {
  for (const Elements kind : kinds) {
    std::vector<double> errors;
    for (const int steps : {100, 200}) {
      Bar bar(kind, network(3, ", strain_exponent: -0.5"));
      double work = 0, lost = 0;
      Mat3 before = Mat3::Identity(), force = Mat3::Zero();
      for (int i = 1; i <= steps; ++i) {
        const Mat3 f = shear(0.5 * std::sin(2 * 3.14159265358979 * i / steps)) * stretch(0.2 * std::sin(3.14159265358979 * i / steps));
        const Mat3 next = bar.step(f, 4.0 / steps) * f.inverse().transpose();
        work += (0.5 * (force + next)).cwiseProduct(f - before).sum();
        lost += bar.lost();
        CHECK(bar.lost() >= 0);
        before = f, force = next;
      }
      errors.push_back(std::abs(work - lost - bar.stored()) / lost);
    }
    INFO(errors[0] << " " << errors[1]);
    CHECK(errors[1] < 0.01);
    CHECK(errors[1] < 0.7 * errors[0]);
    // Steps that reverse the stress.
    std::srand(5);
    Bar bar(kind, network(4));
    for (int i = 0; i < 40; ++i) {
      bar.step(random_deformation(0.3), std::pow(10, i % 5 - 3));
      CHECK(bar.lost() >= 0);
    }
  }
}

TEST_CASE("bergstrom_boyce: a rotation neither strains nor relaxes, and a rejected step leaves nothing", "[bergstrom_boyce]") {
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  for (const Elements kind : kinds) {
    Bar held(kind, network(4)), turned(kind, network(4));
    held.step(stretch(0.3) * shear(0.2), 0.1);
    turned.step(stretch(0.3) * shear(0.2), 0.1);
    turned.term().begin_step({turned.before(), 0, 0.4});  // rejected
    const Mat3 a = held.step(stretch(0.3) * shear(0.2), 0.2), b = turned.step(turn * stretch(0.3) * shear(0.2), 0.2);
    CHECK((turn * a * turn.transpose() - b).norm() < 1e-8 * a.norm());
  }
}

TEST_CASE("bergstrom_boyce: an inverted tet has no finite energy, and a flat one a growing one", "[bergstrom_boyce]") {
  for (const Elements kind : kinds) {
    Bar bar(kind, network(4));
    bar.term().begin_step({bar.before(), 0, 1});
    CHECK(std::isinf(bar.term().value(bar.at(Vec3(1, 1, -1).asDiagonal()))));
    double before = 0;
    for (const double thickness : {0.5, 0.1, 1e-3, 1e-6, 1e-12}) {
      const double energy = bar.term().value(bar.at(Vec3(1, 1, thickness).asDiagonal()));
      CHECK(energy > 1.2 * before);
      before = energy;
    }
  }
}

TEST_CASE("bergstrom_boyce: parameters that are refused", "[bergstrom_boyce]") {
  const TetBody box(Vec3(0.3, 0.2, 0.1), {1, 1, 1});
  CHECK_THROWS_WITH(component<Energy>("{type: bergstrom_boyce, flow_stress: 1, flow_rate: 1, exponent: 2}"), Catch::Contains("give one of the two"));
  CHECK_THROWS_WITH(component<Energy>("{type: bergstrom_boyce, modulus: 1, flow_stress: 1, flow_rate: 1}"), Catch::Contains("exponent"));
  CHECK_THROWS_WITH(component<Energy>(network(0.9)), Catch::Contains("exponent"));
  CHECK_THROWS_WITH(component<Energy>(network(4, ", strain_exponent: 0.5")), Catch::Contains("strain_exponent"));
  CHECK_THROWS_WITH(component<Energy>("{type: bergstrom_boyce, fraction: 2, flow_stress: 1, flow_rate: 1, exponent: 2}")->make_term(box.body, box.rest),
                    Catch::Contains("bergstrom_boyce takes a fraction"));
}

TEST_CASE("bergstrom_boyce: the temperature shifts the rate of each element", "[bergstrom_boyce]") {
  const std::string shift = ", shift: arrhenius, activation_energy: 60 kJ/mol, reference_temperature: 300";
  const auto slowdown = [](double kelvin) { return std::exp(60e3 / 8.31446261815324 * (1 / kelvin - 1 / 300.0)); };
  for (const Elements kind : kinds)
    for (const bool profile : {false, true}) {
      Environment environment;
      bind(parse_string(profile ? "{temperature: 300, profile: (x - 0.15) * 66 + 25 * t}" : "{temperature: [[0, 290], [10, 540]]}", "test.yaml"), environment, "environment");
      CHECK(component<Energy>(network(3, shift))->depends_on_temperature());
      CHECK_FALSE(component<Energy>(network(3))->depends_on_temperature());
      TetBody box(Vec3(0.3, 0.2, 0.1), {2, 1, 1}, kind);
      box.body.environment = &environment;
      const auto shifted = component<Energy>(network(3, shift))->make_term(box.body, box.rest);
      // The sum of the terms of single elements, each with the rate of its temperature.
      const double t = 0.4, h = 0.2;
      const VecX x = box.deformed(stretch(0.3) * shear(0.2));
      double expected = 0;
      const size_t per = kind == Elements::composite ? 8 : 1;
      for (size_t first = 0; first < box.body.tets.size(); first += per) {
        Body one = box.body;
        one.environment = nullptr;
        one.tets.assign(box.body.tets.begin() + static_cast<long>(first), box.body.tets.begin() + static_cast<long>(first + per));
        Vec3 centre = Vec3::Zero();
        for (const Tet& tet : one.tets)
          for (const int v : tet) centre += vertex(box.rest, v) / (4 * static_cast<double>(per));
        const double temperature = environment.temperature(t + h / 2, centre);
        const auto plain =
            component<Energy>(fmt::format("{{type: bergstrom_boyce, modulus: {}, flow_stress: {}, flow_rate: {}, exponent: 3}}", mu, flow_stress, flow_rate / slowdown(temperature)))
                ->make_term(one, box.rest);
        plain->begin_step({box.rest, t, h});
        expected += plain->value(x);
      }
      shifted->begin_step({box.rest, t, h});
      CHECK(shifted->value(x) == Approx(expected).epsilon(1e-9));
      shifted->begin_step({box.rest, 0, h});
      CHECK(shifted->value(x) != Approx(expected).epsilon(1e-4));
    }
}
