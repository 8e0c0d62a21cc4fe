// A bond or an adhesion that does not fail in statics does not fail in long steps: no step starts
// beyond the peak of the traction.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/bond/bond_term.hpp"
#include "framework/config/bind.hpp"
#include "framework/contact/laws/pair_law.hpp"
#include "framework/stepping/predicted_motion.hpp"
#include "tests/support/bond_laws.hpp"
#include "tests/support/gap_law.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

constexpr double side = 0.01, mass = 1e-3;  // of a cube [m, kg]
const std::vector<std::string> integrators = {"implicit_euler", "bdf2", "newmark", "quasi_static"};

struct Law {
  std::string yaml;
  double peak;      // Pa
  double distance;  // of contact [m]
  double gap;       // at the start [m]
};

std::vector<Law> bond_laws() {
  const std::vector<std::map<std::string, std::string>> settings = {
      {{"envelope", "{type: fang, peak_traction: 1e4, peak_distance: 5e-5, range: 2e-4}"}},
      {{"peak_traction", "800"}, {"work_of_adhesion", "0.02"}},
      {{"law", "{type: bilinear, peak_traction: 800, work_of_adhesion: 0.02}"}},
      {{"peak_traction", "800"}},
      {{"peak_traction", "800"}, {"work_of_adhesion", "0.02"}, {"activation_energy", "6e4"}},
      {{"normal_stiffness", "1e8"}, {"work_of_adhesion", "0.01"}, {"tangential_stiffness", "1e8"}},
      {{"stiffness", "1e8"}, {"work_of_adhesion", "0.01"}},
      {{"mixity_exponent", "1.5"}, {"tangential_strength", "2e4"}, {"tangential_work", "3"}}};
  std::vector<Law> laws;
  for (const ComponentVariant& v : variants<AdhesionLaw, BondLaw>(settings)) {
    try {
      laws.push_back({v.yaml, bond_law(v.yaml)->peak_traction(), 5e-4, 6e-4});
    } catch (const InputError&) {
      // values that belong to another law
    }
  }
  return laws;
}

std::vector<Law> gap_laws() {
  const double distance = 5e-6;
  const std::vector<std::map<std::string, std::string>> settings = {
      {}, {{"peak_traction", "800"}, {"work_of_adhesion", "0.0218"}}, {{"peak_traction", "800"}},
      {{"traction", "4e8 * d * exp(-d / 1e-5)"}, {"range", "1e-4"}}, {{"file", TACK_TEST_DATA "/laws/six_rows.csv"}}};
  std::vector<Law> laws;
  for (const ComponentVariant& v : variants<AdhesionLaw, NormalAdhesion>(settings)) {
    try {
      const std::shared_ptr<const NormalAdhesion> law = law_of(v.yaml, distance);
      PairLaw pair;
      pair.add(law);
      // lennard_jones attracts from its equilibrium gap on; below it a cube would fall freely.
      double gap = std::max(1.2 * distance, pair.well().gap);
      while (gap < law->range() && !(pair.at(gap).slope > 0) && !(pair.at(gap).curvature > 0)) gap *= 1.01;
      laws.push_back({v.yaml, law->peak_traction(), distance, gap});
    } catch (const InputError&) {
      // not within this distance
    }
  }
  return laws;
}

// A cube below a plate to which it is bonded.
std::string hanging(const Law& law, const std::string& integrator, double h, double gravity, const std::string& plate, const std::string& cube = "") {
  return fmt::format(
      "gravity: [0, {}, 0]\n"
      "time: {{step: {}, duration: 1, integrator: {}}}\n"
      "solver: {{type: projected_newton, tolerance: 1e-6}}\n"
      "contact: {{distance: {}, pairs: [{{between: [cube, plate], {}adhesion: {}}}]}}\n"
      "objects:\n"
      "  - {{name: plate, shape: {{type: box, size: [0.02, 0.01, 0.02]}}, place: {{translate: [0, 0.005, 0]}}, {}}}\n"
      "  - {{name: cube, shape: {{type: box, size: [0.01, 0.01, 0.01]}}, place: {{translate: [0, {}, 0]}}, "
      "energies: [{{type: neo_hookean, young: 1 MPa, density: 1000}}]{}}}\n",
      -gravity, h, integrator, law.distance, law.distance > 1e-4 ? "bond_distance: 0.7 mm, " : "", law.yaml, plate, -side / 2 - law.gap, cube);
}

double opening(const TestRun& run) {
  const State& s = run.state();
  return run.world->centre_of_mass(0, s.x).y() - run.world->centre_of_mass(1, s.x).y();
}

// Returns the increase of the distance of cube and plate after some steps [m].
double opened(TestRun& run, int steps) {
  const double start = opening(run);
  for (int i = 0; i < steps; ++i) run.step();
  return opening(run) - start;
}

constexpr double apart = 3e-4;  // m

// A minimiser that returns the first guess.
class Rest : public Minimizer {
 public:
  MinimizerResult minimize(const MinimizerProblem&, VecX&) override { return {}; }
};

}  // namespace

TEST_CASE("a cube hangs by an eighth of the strength of any adhesion in steps of 10 ms", "[bonds]") {
  std::vector<Law> laws = bond_laws();
  for (const Law& law : gap_laws()) laws.push_back(law);
  size_t in_statics = 0;
  for (const Law& law : laws) {
    const auto stays_bonded = [&](const std::string& integrator) {
      TestRun run(hanging(law, integrator, 1e-2, law.peak * side * side / (8 * mass), "motion: [fixed]"));
      return opened(run, 3) < apart;
    };
    try {
      if (!stays_bonded("quasi_static")) {
        WARN(law.yaml);
        continue;
      }
    } catch (const SimulationError& e) {
      WARN(law.yaml << " " << e.what());
      continue;
    }
    ++in_statics;
    for (const std::string& integrator : integrators) {
      INFO(law.yaml << ", " << integrator);
      CHECK(stays_bonded(integrator));
    }
  }
  CHECK(in_statics == laws.size());
}

TEST_CASE("bonds carry a moving cube in steps of many times their onset", "[bonds]") {
  for (const Law& law : bond_laws())
    for (const std::string& integrator : integrators)
      for (const double speed : {1e-3, 1.0}) {
        INFO(law.yaml << ", " << integrator << ", " << speed << " m/s");
        // A moving plate pulls it across and along the bonds, at first by a thirtieth of the strength.
        const double acceleration = law.peak * side * side / (30 * mass), until = speed / acceleration, h = std::min(1e-2, until / 2);
        const std::string path = fmt::format("t < {0} ? 0.5 * {1} * t * t : {2} * (t - {0} / 2)", until, acceleration, speed);
        TestRun run(hanging(law, integrator, h, 0, fmt::format("motion: [{{type: formula, x: \"{0}\", y: \"{0}\"}}]", path)));
        CHECK(opened(run, 4) < apart);
      }
}

TEST_CASE("the start of steps without debonding is the inertial motion") {
  const Law law{"{type: bonded, peak_traction: 800}", 800, 5e-4, 6e-4};
  const auto unchanged = [](TestRun& run) {
    const Step step = run.stepper.open(1e-3);
    VecX full, drift;
    run.world->dofs.gather(step.h * (step.state.v + step.h * step.state.a), full);
    run.world->dofs.gather(step.h * step.state.v, drift);
    run.world->participants.move_to(step.state.x);
    const PredictedMotion motion = predicted_motion(*run.world, step.state.x, VecX::Zero(step.state.x.size()), full, drift);
    CHECK_FALSE(full.isZero());
    CHECK((motion.displacements == std::vector{full} && !motion.debonds));
  };
  TestRun free_fall(hanging(law, "implicit_euler", 1e-3, 9.81, "body: {type: affine, density: 1000}"));
  unchanged(free_fall);
  TestRun uniform(hanging(law, "implicit_euler", 1e-3, 0, "velocity: [3, 2, 1], body: {type: affine, density: 1000}", ", velocity: [3, 2, 1]"));
  unchanged(uniform);
  // The prediction would debond the cube, so that it starts without its acceleration.
  TestRun hung(hanging(law, "implicit_euler", 1e-2, 9.81, "motion: [fixed]"));
  const Step step = hung.stepper.open(1e-2);
  VecX full;
  hung.world->dofs.gather(step.h * step.h * step.state.a, full);
  hung.world->participants.move_to(step.state.x);
  const VecX none = VecX::Zero(full.size());
  CHECK(predicted_motion(*hung.world, step.state.x, VecX::Zero(step.state.x.size()), full, none).displacements.front() == none);
}

TEST_CASE("no first guess takes an adhesion past its peak, with any integrator and any law", "[bonds]") {
  std::vector<Law> laws = bond_laws();
  for (const Law& law : gap_laws()) laws.push_back(law);
  constexpr double h = 1e-2;  // s
  int moved = 0;
  for (const std::string& integrator : Registry<TimeIntegrator>::kind().names()) {
    if (!Registry<TimeIntegrator>::make(integrator)->inertia()) continue;
    for (const Law& law : laws)
      for (const double gaps : {1e-3, 0.1, 100.0}) {  // that the cube would move in a step
        INFO(law.yaml << ", " << integrator << ", " << gaps << " gaps in a step");
        TestScene scene(hanging(law, integrator, h, 0, "motion: [fixed]", fmt::format(", velocity: [0, {}, 0]", -gaps * law.gap / h)));
        Rest rest;
        TimeStepper stepper(*scene.world, scene.config, scene.config.time, rest, scene.clock, [](const Warning&) {});
        const VecX start = stepper.state().x, guess = stepper.solve(h).x;
        moved += guess != start;
        scene.world->participants.move_to(start);
        CHECK_FALSE(anything_debonds(*scene.world, start, guess));
      }
  }
  CHECK(moved > 0);
}
