// Sheets that keep their curvature: moments, flow and work against closed forms of bending about one axis, history variables, energy balance.
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

constexpr double stiffness = 2e-3, yield_moment = 0.05;  // N m, N
constexpr double length = 0.1, width = 0.03;             // m
constexpr int cells = 40;

// A strip that is rolled about its width.
class Rolled {
 public:
  Rolled(double hardening, int across, Diagonals diagonals)
      : sheet_(Vec2(length, width), {cells, across}, 1e-4, 0, diagonals),
        term_(component<Energy>(fmt::format("{{type: hinge_bending, stiffness: {}, poisson: 0, yield_moment: {}, hardening: {}}}", stiffness, yield_moment, hardening))
                  ->make_term(sheet_.body, sheet_.rest)) {}

  VecX at(double curvature) const {
    return sheet_.mapped([&](const Vec3& x) {
      if (curvature == 0) return x;
      return Vec3(std::sin(curvature * x.x()) / curvature, (1 - std::cos(curvature * x.x())) / curvature, x.z());
    });
  }
  // The moment per width: the slope of the energy over the curvature. The rows of edges bend over all but half a cell at either end.
  double moment(double curvature) const {
    const double d = 1e-3;
    return (term_->value(at(curvature + d)) - term_->value(at(curvature - d))) / (2 * d) / (length * width * (1 - 1.0 / cells));
  }
  double value(double curvature) const { return term_->value(at(curvature)); }
  double dissipated(double curvature) const { return Published(*term_).flow("dissipated_plastic", at(curvature)); }
  void step_to(double curvature) {
    term_->begin_step({at(before_), 0, 1});
    term_->commit(at(curvature), history_);
    term_->load_history(history_);
    before_ = curvature;
  }
  Term& term() { return *term_; }
  const History& history() const { return history_; }

 private:
  SheetBody sheet_;
  std::unique_ptr<Term> term_;
  History history_;
  double before_ = 0;
};

const auto diagonals = {Diagonals::uniform, Diagonals::alternating};

}  // namespace

TEST_CASE("plastic bending: a strip yields at its yield moment, hardens, and unloads with D", "[shells]") {
  const double onset = yield_moment / stiffness;  // 25 / m
  for (const Diagonals d : diagonals)
    for (const int across : {1, 3, 6})
      for (const double hardening : {0.0, 5e-4}) {
        INFO(across << " cells across, hardening " << hardening);
        // Where four and eight triangles meet at a vertex in turn, fans of four yield early.
        const double tolerance = d == Diagonals::uniform ? 0.015 : 0.065;
        const double tangent = stiffness * hardening / (stiffness + hardening);
        const auto loaded = [&](double k) { return yield_moment + tangent * (k - onset); };
        Rolled strip(hardening, across, d);
        if (d == Diagonals::uniform) CHECK(strip.moment(0.8 * onset) == Approx(0.8 * yield_moment).epsilon(0.002));
        CHECK(strip.moment(0.4 * onset) == Approx(0.4 * yield_moment).epsilon(0.002));
        CHECK(strip.moment(2 * onset) == Approx(loaded(2 * onset)).epsilon(tolerance));
        CHECK(strip.moment(-2 * onset) == Approx(-loaded(2 * onset)).epsilon(tolerance));
        for (const double k : {1.5 * onset, 3 * onset}) strip.step_to(k);
        const double top = strip.moment(3 * onset + 0.01);
        CHECK(top == Approx(loaded(3 * onset)).epsilon(tolerance));
        const double back = onset;  // elastic
        CHECK(strip.moment(3 * onset - back) - top == Approx(-stiffness * back).epsilon(0.002));
        // No moment where the sheet is free: the curvature that is kept.
        CHECK(std::abs(strip.moment(3 * onset - top / stiffness)) <= 0.002 * yield_moment);
      }
}

TEST_CASE("plastic bending: stored energy and plastic work are the whole work, step by step", "[shells]") {
  for (const double hardening : {0.0, 5e-4}) {
    Rolled strip(hardening, 3, Diagonals::alternating);
    double work = 0;
    for (const double k : {10.0, 40.0, 60.0, 20.0, -50.0, -20.0, 30.0}) {
      const double trial = strip.value(k), lost = strip.dissipated(k);
      CHECK(lost >= 0);
      strip.step_to(k);
      CHECK(trial - strip.value(k) == Approx(lost).margin(1e-12 * trial));
      CHECK(strip.dissipated(k) <= 1e-12 * trial);
      work += lost;
    }
    CHECK(work > 0);
    // A term with the same history has the same energy.
    Rolled other(hardening, 3, Diagonals::alternating);
    other.term().load_history(strip.history());
    CHECK(other.value(45) == strip.value(45));
    other.term().load_history({});
    CHECK(other.value(45) != strip.value(45));
  }
}

TEST_CASE("plastic bending: rejected steps do not change the history, and energies balance", "[shells]") {
  TestRun run(
      "time: {step: 0.05, duration: 10, integrator: quasi_static}\n"
      "solver: {type: projected_newton, linear: cholmod, stopping: force, force_tolerance: 1e-9, max_iterations: 40}\nobjects:\n"
      "  - name: strip\n    shape: {type: grid, size: [0.1, 0.03], cells: [20, 3], jitter: 0.1}\n    shell: {thickness: 1 mm}\n"
      "    energies: [{type: stvk_membrane, young: 1e6}, {type: hinge_bending, stiffness: 1e-3, yield_moment: 0.01, hardening: 1e-4}]\n"
      "    motion: [{type: fixed, select: {type: formula, where: x < -0.044}}, {type: rotate, axis: [0, 0, 1], centre: [0, 0, 0], angular_velocity: 1,\n"
      "              select: {type: formula, where: x > 0.044}}]\n");
  EnergyFlows sum;
  StepReport last;
  for (int i = 0; i < 16; ++i) sum += (last = run.step()).flows;
  CHECK(sum.of("dissipated_plastic") > 0);
  double stored = 0;
  for (const NamedEnergy& energy : last.energies) stored += energy.value;
  CHECK(sum.prescribed_motion == Approx(stored + sum.of("dissipated_plastic") + sum.numerics).epsilon(1e-9));
  CHECK(std::abs(sum.numerics) <= 0.1 * sum.prescribed_motion);
  const History before = run.state().history;
  REQUIRE(before.count("strip/energies/1/plastic_angles"));
  REQUIRE(before.count("strip/energies/1/plastic_curvature"));
  run.stepper.solve(0.05);  // and is not accepted
  CHECK(run.state().history == before);
}
