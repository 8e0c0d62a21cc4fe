// Damping of objects against closed forms: a vibration in one mode of a clamped block, small enough
// to be linear, decays with zeta = alpha / (2 w) + beta w / 2 of critical.
#include "framework/core/damping_terms.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/checks/derivative_check.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// A block with a fixed lower face, deflected by its lowest mode.
struct Vibration : TestScene {
  Vibration(const std::string& integrator, double h, double alpha, double beta)
      : TestScene(fmt::format(
            "time: {{step: {}, duration: 10, integrator: {}}}\n"
            "solver: {{type: projected_newton, linear: cholmod, tolerance: 1e-8, balance_tolerance: 1e-6, force_floor: 1e-9}}\n"
            "objects:\n"
            "  - name: block\n    shape: {{type: box, size: [0.1, 0.3, 0.08], cells: [1, 3, 1]}}\n"
            "    energies: [{{type: neo_hookean, young: 1e5, poisson: 0.3, density: 1000}}]\n"
            "    damping: {{stiffness: {}, mass: {} 1/s}}\n"
            "    motion: [{{type: fixed, select: {{type: face, direction: [0, -1, 0]}}}}]\n",
            h, integrator, beta, alpha)) {
    const MatX full = dense_hessian(*world->elastic_terms[0], world->rest, Projection::none);
    const int n = world->dofs.block_count();
    MatX k(3 * n, 3 * n);
    VecX m(3 * n);
    for (int i = 0; i < n; ++i) {
      const int v = world->dofs.vertex_of_block(i);
      m.segment<3>(3 * i).setConstant(world->mass(v));
      for (int j = 0; j < n; ++j) k.block<3, 3>(3 * i, 3 * j) = full.block<3, 3>(3 * v, 3 * world->dofs.vertex_of_block(j));
    }
    const MatX dense_mass = m.asDiagonal();
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatX> modes(k, dense_mass);
    omega = std::sqrt(modes.eigenvalues()(0));
    VecX shape = modes.eigenvectors().col(0);  // of unit modal mass
    shape *= amplitude / shape.lpNorm<Eigen::Infinity>();
    mode = VecX::Zero(world->rest.size());
    world->dofs.scatter(shape, mode);
    world->start.x += mode;
    zeta = alpha / (2 * omega) + beta * omega / 2;
    stepper.emplace(*world, config, config.time, *solver, clock, [](const std::string&) {});
  }

  // Modal coordinate, in units of the initial amplitude.
  double coordinate(const VecX& vectors) const {
    double sum = 0, square = 0;
    for (int v = 0; v < world->mass.size(); ++v) {
      sum += world->mass(v) * vertex(vectors, v).dot(vertex(mode, v));
      square += world->mass(v) * vertex(mode, v).squaredNorm();
    }
    return sum / square;
  }
  double deflection() const { return coordinate(stepper->state().x - world->rest); }
  // sqrt(u^2 + ((v + zeta w u) / w_d)^2), which decays as exp(-zeta w t).
  double envelope() const {
    const double u = deflection(), v = coordinate(stepper->state().v);
    return std::hypot(u, (v + zeta * omega * u) / (omega * std::sqrt(1 - zeta * zeta)));
  }

  static constexpr double amplitude = 1e-4;  // m
  double omega = 0, zeta = 0;
  VecX mode;
  std::optional<TimeStepper> stepper;
};

// Returns the decay rate over some periods, in units of zeta w.
double decay_rate(const std::string& integrator, double alpha, double beta, int steps_per_period, int periods) {
  const Vibration probe(integrator, 1, alpha, beta);
  const double h = 2 * M_PI / probe.omega / steps_per_period;
  Vibration run(integrator, h, alpha, beta);
  const double start = run.envelope();
  for (int i = 0; i < periods * steps_per_period; ++i) run.stepper->advance();
  return std::log(start / run.envelope()) / (run.zeta * run.omega * run.stepper->state().time);
}

// Returns the largest distance from u = exp(-zeta w t) (cos w_d t + zeta w / w_d sin w_d t) in one period.
double error_of(const std::string& integrator, int steps) {
  constexpr double alpha = 2, beta = 0.01;
  const Vibration probe(integrator, 1, alpha, beta);
  const double h = 2 * M_PI / probe.omega / steps, damped = probe.omega * std::sqrt(1 - probe.zeta * probe.zeta);
  Vibration run(integrator, h, alpha, beta);
  double largest = 0;
  for (int i = 0; i < steps; ++i) {
    run.stepper->advance();
    const double t = run.stepper->state().time, rate = run.zeta * run.omega;
    largest = std::max(largest, std::abs(run.deflection() - std::exp(-rate * t) * (std::cos(damped * t) + rate / damped * std::sin(damped * t))));
  }
  return largest;
}

const std::string block = "{name: block, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, energies: [{type: neo_hookean, young: 1e5}]";
std::string header(const std::string& integrator) {
  return "time: {step: 5 ms, duration: 10, integrator: " + integrator + "}\n"
         "solver: {type: projected_newton, linear: cholmod, tolerance: 1e-9}\n";
}

}  // namespace

TEST_CASE("a vibration decays with Rayleigh's damping", "[damping]") {
  CHECK(decay_rate("newmark", 3, 0, 60, 2) == Approx(1).epsilon(0.02));
  CHECK(decay_rate("newmark", 0, 0.01, 60, 2) == Approx(1).epsilon(0.02));
  CHECK(decay_rate("newmark", 3, 0.01, 60, 2) == Approx(1).epsilon(0.02));
  CHECK(decay_rate("bdf2", 3, 0.01, 200, 1) == Approx(1).epsilon(0.02));
}

TEST_CASE("damping has the order of the integrator", "[damping]") {
  CHECK(error_of("implicit_euler", 100) / error_of("implicit_euler", 200) == Approx(2).epsilon(0.15));
  CHECK(error_of("newmark", 40) / error_of("newmark", 80) == Approx(4).epsilon(0.15));
  CHECK(error_of("bdf2", 100) / error_of("bdf2", 200) == Approx(4).epsilon(0.25));
}

TEST_CASE("stiffness damping leaves free fall alone, mass damping ends at g / alpha", "[damping]") {
  for (const std::string integrator : {"implicit_euler", "bdf2", "newmark"}) {
    INFO(integrator);
    const auto falling = [&](const std::string& damping) {
      return header(integrator) + "gravity: [0, -9.81, 0]\nobjects: [" + block + ", velocity: [1, 2, 0]" + damping + "}]\n";
    };
    TestRun stiff(falling(", damping: {stiffness: 20 ms}")), free(falling("")), heavy(falling(", damping: {mass: 5 1/s}"));
    double damped = 0;
    for (int i = 0; i < 40; ++i) {
      damped += stiff.step().flows.of("dissipated_damping");
      free.step();
      heavy.step();
    }
    CHECK((stiff.state().x - free.state().x).lpNorm<Eigen::Infinity>() <= 1e-9);
    CHECK(damped <= 1e-12);
    // Implicit Euler: v' = (v - h g) / (1 + h alpha).
    const double left = integrator == "implicit_euler" ? std::pow(1 + 5e-3 * 5, -40) : std::exp(-5 * heavy.state().time);
    const double expected = 2 * left - 9.81 / 5 * (1 - left);
    CHECK(heavy.state().v(1) == Approx(expected).epsilon(integrator == "bdf2" ? 5e-3 : 1e-3));
  }
}

TEST_CASE("damping dissipates the energy that a vibration loses", "[damping]") {
  for (const std::string integrator : {"implicit_euler", "bdf2", "newmark"}) {
    INFO(integrator);
    const double h = integrator == "newmark" ? 5e-3 : 1e-3;
    Vibration run(integrator, h, 2, 0.01);
    const double start = run.world->elastic_terms[0]->value(run.stepper->state().x);
    EnergyFlows sum;
    StepReport last;
    for (int i = 0; i < 0.3 / h; ++i) {
      sum += (last = run.stepper->advance()).flows;
      REQUIRE(last.flows.of("dissipated_damping") >= 0);
      REQUIRE_FALSE(last.flows.damped);
    }
    double left = 0;
    for (const NamedEnergy& energy : last.energies) left += energy.value;
    CHECK(left < 0.5 * start);
    CHECK(sum.of("dissipated_damping") + sum.numerics == Approx(start - left).epsilon(1e-6));
    if (integrator == "newmark") CHECK(sum.of("dissipated_damping") == Approx(start - left).epsilon(2e-3));
    if (integrator == "bdf2") CHECK(sum.of("dissipated_damping") == Approx(start - left).epsilon(0.03));
    CHECK(run.stepper->state().energy.dissipated_as("dissipated_damping") == Approx(sum.of("dissipated_damping")).epsilon(1e-12));
  }
}

TEST_CASE("the work of a prescribed motion against damping is dissipated", "[damping]") {
  for (const std::string integrator : {"implicit_euler", "newmark"}) {
    INFO(integrator);
    TestRun run(header(integrator) + "objects: [" + block +
                   ", damping: {stiffness: 0.2 s}, motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}},\n"
                   "  {type: formula, y: 0.001 * (1 - cos(10 * t)), select: {type: face, direction: [0, 1, 0]}}]}]\n");
    EnergyFlows sum;
    StepReport last;
    for (int i = 0; i < 126; ++i) sum += (last = run.step()).flows;  // once up and down
    double left = 0;
    for (const NamedEnergy& energy : last.energies) left += energy.value;
    CHECK(sum.prescribed_motion == Approx(sum.of("dissipated_damping") + left).epsilon(0.03));
    CHECK(sum.of("dissipated_damping") > 0.5 * sum.prescribed_motion);
  }
}

TEST_CASE("damping terms have the derivatives of their value", "[damping]") {
  TestScene scene(header("implicit_euler") + "objects: [" + block + ", damping: {stiffness: 20 ms, mass: 3 1/s}}]\n");
  int damping = 0;
  for (const DerivativeCheck& check : check_derivatives(*scene.world, 0.01, scene.clock)) {
    INFO(check.term);
    CHECK_FALSE(check.wrong());
    damping += check.term == "damping" && check.active();
  }
  CHECK(damping == 1);
}

TEST_CASE("quasi-static steps refuse damping, and damping coefficients have units", "[damping]") {
  const auto scene = [](const std::string& integrator, const std::string& damping) {
    TestScene(header(integrator) + "objects: [" + block + ", damping: " + damping + "}]\n");
  };
  CHECK_THROWS_WITH(scene("quasi_static", "{stiffness: 1 ms}"),
                    Catch::Contains("object 'block': damping acts on velocities") && Catch::Contains("quasi_static"));
  CHECK_THROWS_WITH(scene("newmark", "{mass: 1 s}"), Catch::Contains("expects a rate (1/s)"));
  CHECK_THROWS_WITH(scene("newmark", "{stiffness: -1 ms}"), Catch::Contains("stiffness"));
  CHECK_NOTHROW(scene("newmark", "{mass: 0.1 1/s}"));
}

TEST_CASE("an affine body has mass damping, and refuses stiffness damping", "[damping]") {
  const auto affine = [](const std::string& damping) {
    return header("newmark") + "objects: [{name: rigid, shape: {type: box, size: [0.2, 0.1, 0.1]}, body: affine,\n"
           "  velocity: [1, 2, 0], spin: [0, 0, 0.1], damping: " + damping + "}]\n";
  };
  TestRun run(affine("{mass: 5 1/s}"));
  const Vec3 start = run.world->centre_of_mass(0, run.state().x);
  double lost = 0;
  for (int i = 0; i < 40; ++i) lost += run.step().flows.of("dissipated_damping");
  const double left = std::exp(-5 * run.state().time);  // of the velocity
  CHECK((run.world->centre_of_mass(0, run.state().x) - start).isApprox((1 - left) / 5 * Vec3(1, 2, 0), 1e-3));
  CHECK(lost == Approx(0.5 * 2 * (5 + 0.01 * (0.04 + 0.01) / 12) * (1 - left * left)).epsilon(1e-3));
  CHECK_THROWS_WITH(TestRun(affine("{stiffness: 1 ms}")), Catch::Contains("'rigid' is an affine body"));
}

TEST_CASE("a scene without damping has no damping terms", "[damping]") {
  CHECK(TestScene(header("newmark") + "objects: [" + block + "}]\n").world->damping_terms.empty());
}
