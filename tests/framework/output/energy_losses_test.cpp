// Warnings at the end of a run about numerical energy gains and losses.
#include "framework/output/energy_losses.hpp"

#include <catch2/catch.hpp>

#include "framework/output/summary.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

const auto newmark = Registry<TimeIntegrator>::make("newmark"), euler = Registry<TimeIntegrator>::make("implicit_euler");

// Returns step k of 10 ms of a run with a reference energy of 2 J, 1 J of it kinetic.
StepReport step(int k, double areas, double numerics) {
  StepReport r;
  r.step = k;
  r.time = 0.01 * k;
  r.step_size = 0.01;
  r.flows.areas = areas;
  r.flows.numerics = numerics;
  r.flows.reference_energy = k < 3 ? 1e-3 : 2;
  r.flows.moving = k < 3 ? 1e-3 : 1;
  r.flows.noise = 1e-9;
  return r;
}

}  // namespace

TEST_CASE("losses: small losses are not reported, even if they were large at the beginning", "[losses]") {
  EnergyLosses losses;
  losses.add(step(1, -1e-3, 0));  // all of the present reference energy
  for (int k = 2; k <= 20; ++k) losses.add(step(k, 0, k % 2 ? 0.05 : -0.05));  // alternating: the sum is zero
  CHECK(losses.reference_energy == 2);
  CHECK(losses.warnings(*newmark).empty());
}

TEST_CASE("losses: warnings have cause, amount and time, the largest first", "[losses]") {
  EnergyLosses losses;
  for (int k = 1; k <= 40; ++k) losses.add(step(k, k == 7 ? -0.1 : 0, k > 30 ? 0.02 : 0.0001));
  const auto reported = losses.warnings(*newmark);
  REQUIRE(reported.size() == 2);
  CHECK(reported[0].kind == WarningKind::energy_integration);
  CHECK(contains(first_text(reported, WarningKind::energy_integration), "time integration lost 0.203 J, 10% of the reference energy (2 J), mainly from t = 0.3 to 0.39 s: what turns"));
  CHECK(contains(first_text(reported, WarningKind::energy_areas), "areas of contact gained 0.1 J, 5% of the reference energy (2 J), mainly from t = 0.06 to 0.07 s: overlap areas"));
  CHECK(losses.areas.sum == Approx(-0.1));
}

TEST_CASE("losses: repeated steps, contact and jerks of prescribed motions count separately", "[losses]") {
  EnergyLosses losses;
  for (int k = 1; k <= 4; ++k) {
    StepReport r = step(k, 0, 0.1);
    r.flows.damped = k <= 2;
    r.flows.in_contact = k == 3;
    losses.add(r);
  }
  CHECK(losses.repeated.lost == Approx(0.2));
  first_text(losses.warnings(*newmark), WarningKind::energy_repeats);
  CHECK(losses.integrator.lost == Approx(0.2));
  CHECK(losses.integrator.in_contact == Approx(0.1));
  StepReport jerk = step(5, 0, -0.5);
  jerk.flows.jerk = 0.5;
  losses.add(jerk);
  CHECK(losses.integrator.gained == 0);
}

TEST_CASE("losses: three groups are named, the others counted", "[losses]") {
  EnergyLosses losses;
  std::vector<std::string> names;
  for (const char* name : {"'a'", "'b'", "'c'", "'d'", "'e'"}) names.push_back(name);
  StepReport report = step(3, 0, 0);
  for (size_t i = 0; i < names.size(); ++i) {
    GroupFlow flow;
    flow.numerics = 0.1 * static_cast<double>(i + 1), flow.reference_energy = flow.moving = 1;
    report.flows.groups.push_back(flow);
  }
  losses.add(report);
  const auto reported = losses.warnings(*newmark, names);
  REQUIRE(reported.size() == 4);
  for (const int i : {0, 1, 2}) CHECK(reported[i].subject == names[4 - i]);
  CHECK(contains(first_text(reported, WarningKind::energy_further_groups), "2 more groups"));
}

TEST_CASE("losses: losses of damping integrators are accepted if hardly anything moves", "[losses]") {
  EnergyLosses losses;
  for (int k = 1; k <= 4; ++k) losses.add(step(k, 0, 0.5));
  CHECK(losses.warnings(*newmark).size() == 1);
  CHECK(losses.warnings(*euler).size() == 1);
  losses.moving = 0.1;
  CHECK(losses.warnings(*newmark).size() == 1);
  CHECK(losses.warnings(*euler).empty());
}

TEST_CASE("losses: sums continue from a checkpoint", "[losses]") {
  RunSummary whole, first, second;
  for (int k = 1; k <= 200; ++k) {
    const StepReport r = step(k, k % 3 - 1.1, 0.1 * k);
    whole.add(r);
    (k <= 90 ? first : second).add(r);
    if (k == 90) set_totals(second, totals_of(first));
  }
  CHECK(totals_of(second) == totals_of(whole));
  REQUIRE(whole.losses.warnings(*newmark).size() == 2);
  for (int i : {0, 1}) CHECK(second.losses.warnings(*newmark)[i].text == whole.losses.warnings(*newmark)[i].text);
}

TEST_CASE("losses: a histogram of time grows with the run", "[losses]") {
  TimeHistogram when;
  for (int k = 0; k < 1000; ++k) when.add(0.01 * (k + 0.5), 0.01, k >= 500 && k < 548 ? -1 : 0.001);
  CHECK(when.width == Approx(0.16));
  double sum = 0;
  for (const double s : when.sums) sum += s;
  CHECK(sum == Approx(-48 + 0.952));
  const auto [from, to] = when.densest(-40);
  CHECK(from == Approx(4.96).margin(0.17));
  CHECK(to == Approx(5.48).margin(0.17));
  CHECK(when.densest(1).second == Approx(64 * 0.16));  // there is none
}

// Runs with and without a warning.
TEST_CASE("losses: the reference energy is that of the whole run", "[losses]") {
  const auto reported = [](const std::string& yaml, double duration) {
    TestRun run(yaml);
    RunSummary summary;
    while (run.state().time < duration * (1 - 1e-9)) summary.add(run.step());
    std::vector<Warning> warnings = summary.losses.warnings(*run.config.time.integrator);
    std::copy_if(run.warnings.begin(), run.warnings.end(), std::back_inserter(warnings), [](const Warning& w) { return w.kind == WarningKind::energy_growth; });
    return warnings;
  };
  const std::string solver = "solver: {type: projected_newton, tolerance: 1e-4}\n";
  const std::string floor = "  - {name: floor, shape: {type: box, size: [0.5, 0.02, 0.5]}, place: {translate: [0, -0.01, 0]}, motion: [fixed]}\n";
  const std::string block = "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [0, 0.055, 0]},\n"
                            "     velocity: [0, -1, 0], energies: [{type: neo_hookean, young: 10 MPa}]}\n";
  SECTION("an impact that no step resolves") {
    const std::vector<Warning> given = reported("time: {step: 2 ms, duration: 1, integrator: newmark}\n" + solver + "objects:\n" + floor + block + "contact: {distance: 1 mm}\n", 0.02);
    CHECK_THAT(first_text(given, WarningKind::energy_integration), Catch::Contains("time integration lost") && Catch::Contains("contact that comes and goes within a few steps"));
  }
  SECTION("a block in free flight") {
    CHECK(reported("time: {step: 2 ms, duration: 1, integrator: newmark}\n" + solver + "gravity: [0, -9.81, 0]\nobjects:\n" + block, 0.02).empty());
  }
  // The plate enters the range of adhesion with hardly any energy, and leaves it with all of it.
  SECTION("plates that meet and part") {
    CHECK(reported("time: {step: 10 ms, duration: 1}\n" + solver + "objects:\n" + floor +
                   "  - {name: plate, shape: {type: box, size: [0.02, 0.005, 0.02], cells: [3, 1, 3]}, place: {translate: [0, 8.5 mm, 0]},\n"
                   "     energies: [{type: neo_hookean, young: 20 MPa}],\n"
                   "     motion: [{type: keyframes, select: {type: face, direction: [0, 1, 0]}, frames: [{time: 0, translation: [0, 0, 0]},\n"
                   "     {time: 0.5, translation: [0, -5.2 mm, 0]}, {time: 1, translation: [0, 0, 0]}]}]}\n"
                   "contact:\n  distance: 0.05 mm\n  pairs: [{between: [floor, plate], adhesion: {type: fang, peak_traction: 1 kPa, peak_distance: 1 mm, range: 2 mm}}]\n", 1).empty());
  }
}
