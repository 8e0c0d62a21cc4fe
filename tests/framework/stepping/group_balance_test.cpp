// The energy balance of groups of bodies that do not interact.
#include "framework/stepping/group_balance.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/output/summary.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

const std::string head = "time: {step: 2 ms, duration: 20 ms, integrator: newmark}\nsolver: {type: projected_newton, tolerance: 1e-6}\ngravity: [0, -9.81, 0]\n";

std::string floor_at(const char* name, double x, double y) {
  return fmt::format("  - {{name: {}, shape: {{type: box, size: [0.5, 0.02, 0.5]}}, place: {{translate: [{}, {}, 0]}}, motion: [fixed]}}\n", name, x, y);
}

struct Losses {
  std::vector<Warning> warnings;
  double scene_loss = 0, reference_energy = 0;  // J
};

Losses losses_of(const std::string& objects, int steps) {
  TestRun run(head + "objects:\n" + objects + "contact: {distance: 1 mm}\n");
  RunSummary summary;
  for (int i = 0; i < steps; ++i) summary.add(run.step());
  Losses losses{{}, summary.losses.integrator.lost, summary.losses.reference_energy};
  losses.warnings = summary.losses.warnings(*run.config.time.integrator, run.stepper.energy_groups());
  return losses;
}

}  // namespace

TEST_CASE("energy loss of a small body beside a heavy bouncing one is warned of as it is alone", "[energy]") {
  const std::string block = floor_at("floor", 0, -0.01) +
                            "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [0, 0.055, 0]},\n"
                            "     velocity: [0, -1, 0], energies: [{type: neo_hookean, young: 10 MPa}]}\n";
  // It bounces on its fixed base for many steps.
  const std::string heavy = "  - {name: heavy, shape: {type: box, size: [0.4, 0.4, 0.4], cells: [2, 2, 2]}, place: {translate: [10, 0.2, 0]}, velocity: [0, -1, 0],\n"
                            "     energies: [{type: neo_hookean, young: 200 kPa}], motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}]}\n";
  const Losses alone = losses_of(block, 10), beside = losses_of(block + heavy, 10), only_heavy = losses_of(heavy, 10);
  CHECK_THAT(first_text(alone.warnings, WarningKind::energy_integration), Catch::Contains("energy: time integration lost"));
  CHECK_THAT(first_text(beside.warnings, WarningKind::energy_integration), Catch::Contains("energy of 'block': time integration lost") && Catch::Contains("contact that comes and goes within a few steps"));
  for (const Warning& warning : beside.warnings) CHECK(warning.subject == "'block'");
  CHECK(only_heavy.warnings == std::vector<Warning>{});
  // Negative control: the sum over the scene would hide the loss.
  CHECK(beside.scene_loss < EnergyLosses::tolerated_fraction * beside.reference_energy);
}

// Groups separate all flows: stored, fed and dissipated energy.
TEST_CASE("the energy balances of groups add up to that of the scene", "[energy]") {
  const std::string soft = "energies: [{type: neo_hookean, young: 1 MPa, density: 1000}]";
  const std::string objects =
      floor_at("floor", 0, -0.01) +
      "  - {name: slider, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [0, 0.0505, 0]}, velocity: [1, -0.3, 0], damping: {stiffness: 1 ms, mass: 1}, " + soft + "}\n" +
      floor_at("second_floor", 10, -0.01) +
      "  - {name: cube, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [10, 0.0506, 0]}, velocity: [0.5, -0.2, 0], body: {type: affine, density: 1000}}\n"
      "  - {name: pushed, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [20, 0, 0]}, " + soft + "}\n"
      "  - {name: pusher, shape: {type: box, size: [0.05, 0.05, 0.05]}, place: {translate: [19.9245, 0, 0]}, motion: [{type: keyframes, frames: [{time: 0, translation: [0, 0, 0]}, {time: 1, translation: [1, 0, 0]}]}]}\n"
      "  - {name: yields, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [30, 0, 0]},\n"
      "     motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}, {type: keyframes, select: {type: face, direction: [0, 1, 0]}, frames: [{time: 0, translation: [0, 0, 0]}, {time: 1, translation: [0, 1, 0]}]}],\n"
      "     energies: [{type: neo_hookean, young: 1 MPa, density: 1000}]}\n"
      "  - {name: base, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [40, 0, 0]}, motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}], " + soft + "}\n"
      "  - {name: stuck, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [40, 0.1003, 0]}, velocity: [0, 2, 0], " + soft + "}\n";
  TestRun run(head + "objects:\n" + objects +
              "contact:\n  distance: 1 mm\n  friction: {mu: 0.3}\n"
              "  pairs: [{between: [base, stuck], bond_distance: 1 mm, adhesion: {type: rcc, normal_stiffness: 1e8 Pa/m, work_of_adhesion: 1 J/m^2}}]\n");
  std::vector<double> largest_flows(5, 0);
  for (int i = 0; i < 10; ++i) {
    const StepReport r = run.step();
    REQUIRE(r.flows.groups.size() == 5);
    double sum = 0, reference_energy = 0;
    for (size_t g = 0; g < 5; ++g) {
      const GroupFlow& flow = r.flows.groups[g];
      sum += flow.numerics;
      largest_flows[g] = std::max(largest_flows[g], std::abs(flow.numerics));
      reference_energy = std::max(reference_energy, flow.reference_energy);
      CHECK_FALSE(flow.met_another);
    }
    INFO("step " << i);
    CHECK(sum == Approx(r.flows.numerics + r.flows.areas).margin(1e-9 * reference_energy));
  }
  CHECK(run.stepper.energy_groups() == std::vector<std::string>{"'slider'", "'cube'", "'pushed'", "'yields'", "'base' and 1 more"});
  for (const double largest : largest_flows) CHECK(largest > 0);
}
