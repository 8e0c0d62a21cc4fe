// Plasticity of a membrane at a point (a sheet that deforms homogeneously), against closed forms of plane stress.
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/scene/energy.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/published.hpp"
#include "tests/support/sheet_body.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

constexpr double young = 1e6, poisson = 0.3, yield_stress = 2e3, mu = young / (2 * (1 + poisson));  // Pa
constexpr double yield_strain = yield_stress / young;

using Mat2 = Eigen::Matrix2d;

class Point {
 public:
  explicit Point(double hardening)
      : term_(component<Energy>(fmt::format("{{type: von_mises_membrane, young: {}, poisson: {}, yield_stress: {}, hardening: {}}}", young,
                                            poisson, yield_stress, hardening))
                  ->make_term(sheet().body, sheet().rest)) {}

  const Term& term() const { return *term_; }
  const History& history() const { return history_; }
  VecX at(const Mat2& f) const {
    return sheet().mapped([&](const Vec3& x) {
      const Vec2 y = f * Vec2(x.x(), x.z());
      return Vec3(y.x(), 0, y.y());
    });
  }
  double value(const Mat2& f) const { return term_->value(at(f)) / sheet().volume; }
  double dissipated(const Mat2& f) const { return Published(*term_).flow("dissipated_plastic", at(f)) / sheet().volume; }

  Mat2 kirchhoff(const Mat2& f) const {
    const VecX gradient = dense_gradient(*term_, at(f));
    Mat3 piola = Mat3::Zero();
    for (int v = 0; v < sheet().body.vertex_count; ++v) piola += Vec3(vertex(gradient, v)) * Vec3(vertex(sheet().rest, v)).transpose();
    Mat2 flat;
    flat << piola(0, 0), piola(0, 2), piola(2, 0), piola(2, 2);
    return flat / sheet().volume * f.transpose();
  }

  void step_to(const Mat2& f) {
    term_->commit(at(f), history_);
    term_->load_history(history_);
  }

  // A strip with free sides at the logarithmic strain e, by bisection on the strain across.
  Mat2 strip(double e) const {
    double low = -0.5, high = 0.5;
    const auto shape = [&](double side) -> Mat2 { return Vec2(std::exp(e), std::exp(side)).asDiagonal(); };
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (kirchhoff(shape(middle))(1, 1) > 0 ? high : low) = middle;
    }
    return shape((low + high) / 2);
  }
  double pull(double from, double to, int steps) {
    for (int i = 1; i <= steps; ++i) step_to(strip(from + (to - from) * i / steps));
    return kirchhoff(strip(to))(0, 0);
  }
  double plastic_strain() const { return Published(*term_).field("plastic_strain")(0); }

 private:
  static const SheetBody& sheet() {
    static const SheetBody s(Vec2(0.3, 0.2), {2, 1}, 1e-3, 0, Diagonals::alternating);
    return s;
  }

  std::unique_ptr<Term> term_;
  History history_;
};

Mat2 random_deformation(RandomMotions& random, double size) {
  const Eigen::Rotation2Dd a(random.uniform(-3, 3)), b(random.uniform(-3, 3));
  return a.toRotationMatrix() * Vec2(std::exp(random.uniform(-size, size)), std::exp(random.uniform(-size, size))).asDiagonal() *
         b.toRotationMatrix();
}

double von_mises(const Mat2& s) {
  return std::sqrt(s(0, 0) * s(0, 0) - s(0, 0) * s(1, 1) + s(1, 1) * s(1, 1) + 3 * s(0, 1) * s(0, 1));
}

}  // namespace

TEST_CASE("von Mises membrane: a strip in tension yields at its yield stress, flows, and unloads with E", "[shells]") {
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
    const double top = point.kirchhoff(point.strip(0.3))(0, 0);
    CHECK(point.plastic_strain() == Approx(0.3 - top / young).epsilon(1e-6));
    const double back = 1.9 * top / young;
    CHECK(point.pull(0.3, 0.3 - back, 3) == Approx(top - young * back).epsilon(1e-6));
    CHECK(point.pull(0.3 - back, 0.3, 3) == Approx(top).epsilon(1e-6));
    CHECK(point.plastic_strain() == Approx(0.3 - top / young).epsilon(1e-6));
    CHECK(point.pull(0.3, 0.3 - 2.5 * top / young, 3) == Approx(-top - tangent * 0.5 * top / young).epsilon(1e-6));
  }
}

TEST_CASE("von Mises membrane: shear yields at sigma_y / sqrt(3)", "[shells]") {
  Point point(0);
  const auto pure = [](double g) -> Mat2 {  // logarithmic strain g / 2 along the diagonals
    Mat2 f;
    f << std::cosh(g / 2), std::sinh(g / 2), std::sinh(g / 2), std::cosh(g / 2);
    return f;
  };
  const double yields = yield_stress / std::sqrt(3) / mu;
  CHECK(point.kirchhoff(pure(0.99 * yields))(0, 1) == Approx(0.99 * yield_stress / std::sqrt(3)).epsilon(1e-9));
  for (const double g : {1.5 * yields, 0.01, 0.2}) {
    point.step_to(pure(g));
    CHECK(point.kirchhoff(pure(g))(0, 1) == Approx(yield_stress / std::sqrt(3)).epsilon(1e-9));
  }
}

TEST_CASE("von Mises membrane: stresses stay on the yield surface, also after a step is accepted", "[shells]") {
  RandomMotions random(5);
  for (const double hardening : {0.0, 3e5}) {
    Point point(hardening);
    int flows = 0;
    double strain = 0;
    for (int trial = 0; trial < 40; ++trial) {
      const Mat2 f = random_deformation(random, trial % 2 ? 0.4 : 0.003);
      const Mat2 before = point.kirchhoff(f);
      const double energy = point.value(f), work = point.dissipated(f);
      CHECK(work >= 0);
      point.step_to(f);
      const Mat2 after = point.kirchhoff(f);
      CHECK((before - after).norm() <= 1e-9 * (before.norm() + yield_stress));
      CHECK((before - before.transpose()).norm() <= 1e-9 * (before.norm() + yield_stress));
      CHECK(energy - point.value(f) == Approx(work).margin(1e-9 * energy));  // stored energy and dissipation are the whole work
      CHECK(von_mises(after) <= (yield_stress + hardening * point.plastic_strain()) * (1 + 1e-9));
      CHECK(point.dissipated(f) == 0);
      const bool flowed = point.plastic_strain() > strain;
      if (flowed) CHECK(von_mises(after) == Approx(yield_stress + hardening * point.plastic_strain()).epsilon(1e-9));
      if (flowed) CHECK(work > 0);
      flows += flowed;
      strain = point.plastic_strain();
    }
    CHECK(flows >= 8);
    // Equals that of a sheet with equal history variables.
    Point other(hardening);
    const_cast<Term&>(other.term()).load_history(point.history());
    const Mat2 f = random_deformation(random, 0.2);
    CHECK(other.value(f) == point.value(f));
  }
}

TEST_CASE("von Mises membrane: rejected steps do not change the history, and energies balance", "[shells]") {
  const std::string scene =
      "time: {step: 0.05, duration: 10, integrator: quasi_static}\n"
      "solver: {type: projected_newton, linear: cholmod, stopping: force, force_tolerance: 1e-10, max_iterations: 12}\nobjects:\n"
      "  - name: strip\n    shape: {type: grid, size: [0.2, 0.1], cells: [6, 3], jitter: 0.1}\n    shell: {thickness: 1 mm}\n"
      "    energies: [{type: von_mises_membrane, young: 1e6, yield_stress: 2e3, hardening: 1e5}]\n"
      "    motion: [{type: fixed, select: {type: face, direction: [-1, 0, 0]}}, {type: fixed, along: [0, 1, 0]},\n"
      "             {type: translate, along: [1, 0, 0], velocity: [4 mm/s, 0, 0], select: {type: face, direction: [1, 0, 0]}}]\n";
  TestRun run(scene);
  EnergyFlows sum;
  StepReport last;
  for (int i = 0; i < 10; ++i) {
    sum += (last = run.step()).flows;
    CHECK(last.flows.of("dissipated_plastic") >= 0);
  }
  CHECK(sum.of("dissipated_plastic") > 0);
  double stored = 0;
  for (const NamedEnergy& energy : last.energies) stored += energy.value;
  CHECK(sum.prescribed_motion == Approx(stored + sum.of("dissipated_plastic") + sum.numerics).epsilon(1e-9));
  CHECK(std::abs(sum.numerics) <= 0.05 * sum.prescribed_motion);
  const History before = run.state().history;
  REQUIRE(before.count("strip/energies/0/plastic_inverse"));
  bool failed = false;
  for (const double h : {5.0, 200.0}) {
    const SolveResult result = run.stepper.solve(h);
    failed = failed || !run.stepper.validate(result).fault.empty();
    CHECK(run.state().history == before);
  }
  CHECK(failed);
}
