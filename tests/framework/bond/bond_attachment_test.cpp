// Bonds whose site slides along the opposite surface: sliding off, and healing.
#include "framework/bond/bond_attachment.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "framework/bond/bond_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// The upper plate lies over 10 mm of the lower one, 0.8 mm above it.
std::string plates(const std::string& law) {
  const auto box = [](const char* name, const char* size, const char* at) {
    return fmt::format("  - {{name: {}, shape: {{type: box, size: {}, cells: [5, 1, 6]}}, place: {{translate: {}}}, energies: [{{type: neo_hookean, young: 1e6}}]}}\n",
                       name, size, at);
  };
  return "objects:\n" + box("lower", "[0.03, 0.002, 0.03]", "[0, 0, 0]") + box("upper", "[0.03, 0.002, 0.02]", "[0.02, 0.0028, 0]") +
         "contact: {distance: 1e-3, barrier: {type: clamped_log, stiffness: 3e3}, pairs: [{between: [lower, upper], adhesion: " + law + "}]}\n";
}

// After a step in which the upper plate was moved: how many bonds are left, and the energies [J].
struct Slid {
  int bonds;
  double stored, dissipated;
};

Slid slide(const std::string& law, const Vec3& way) {
  TestScene scene(plates(law));
  World& world = *scene.world;
  VecX x = world.rest;
  world.participants.load_history(world.start.history);
  world.participants.begin_step({x, 0, 1e-3});
  const Body& upper = world.bodies[1];
  for (int v = upper.first_vertex; v < upper.first_vertex + upper.vertex_count; ++v) vertex(x, v) += way;
  const double dissipated = world.bonds->changes(x).dissipated;
  History history;
  world.participants.commit(x, history);
  world.participants.load_history(history);
  return {world.bonds->list().size(), world.bonds->value(x), dissipated};
}

}  // namespace

TEST_CASE("bonds without tangential strength end when they slide off the surface, with their stored energy", "[bonds]") {
  const std::string law = GENERATE(as<std::string>(), "{type: rcc, normal_stiffness: 1e7, work_of_adhesion: 0.5}",
                                   "{type: bonded, peak_traction: 1e3, onset: 1e-3, tangential_strength: 0}",
                                   "{type: bilinear, peak_traction: 1e3, work_of_adhesion: 1, tangential_strength: 0}",
                                   "{type: exponential, peak_traction: 1e3, work_of_adhesion: 1, tangential_strength: 0}",
                                   "{type: xu_needleman_coupled, peak_traction: 1e3, work_of_adhesion: 1, tangential_strength: 0}",
                                   "{type: damage, envelope: {type: xu_needleman, peak_traction: 1e3, work_of_adhesion: 1}, tangential_strength: 0}");
  INFO(law);
  const Slid rest = slide(law, {0, 1e-4, 0}), within = slide(law, {-5e-3, 1e-4, 0}), half = slide(law, {5e-3, 1e-4, 0}), off = slide(law, {2e-2, 1e-4, 0});
  REQUIRE(rest.bonds > 0);
  CHECK(within.bonds == rest.bonds);
  CHECK(within.stored == Approx(rest.stored));
  CHECK(half.bonds < rest.bonds);
  CHECK(half.stored == Approx(0.5 * rest.stored).epsilon(0.25));  // 5 of 10 mm
  CHECK(half.stored + half.dissipated == Approx(rest.stored + rest.dissipated));
  CHECK(off.bonds == 0);
  CHECK(off.dissipated == Approx(rest.stored + rest.dissipated));
}

// Pressed with 6.75 kPa, slid, left for 50 ms and lifted: the pull is that of bonds which healed without a slide.
TEST_CASE("bonds that heal at rest are as strong as bonds that never slid, and healing adds no energy", "[bonds]") {
  const double area = 64e-6, work = 1, stiffness = 1e8;
  for (const double slip : {0.0, 3e-5, 1e-4, 1e-3}) {
    INFO(slip << " m");
    TestRun run(fmt::format(R"yaml(
time: {{step: 2 ms, duration: 0.16 s, integrator: quasi_static}}
objects:
  - {{name: lo, shape: {{type: box, size: [12 mm, 2 mm, 10 mm], cells: [5, 1, 2]}}, place: {{translate: [0, -1 mm, 0]}}, motion: [fixed]}}
  - name: up
    shape: {{type: box, size: [8 mm, 2 mm, 8 mm], cells: [2, 1, 3]}}
    place: {{translate: [0, 1.2 mm, 0]}}
    energies: [{{type: neo_hookean, young: 10 GPa, poisson: 0}}]
    motion:
      - type: formula
        x: "{} * max(0, min(1, (t - 0.02) / 0.02))"
        y: "t < 0.01 ? -0.014 * t : t < 0.1 ? -1.4e-4 : -1.4e-4 + 4e-3 * (t - 0.1)"
        select: {{type: face, direction: [0, 1, 0]}}
contact:
  distance: 0.1 mm
  barrier: {{type: clamped_log, stiffness: 10 kPa}}
  pairs:
    - between: [up, lo]
      adhesion: {{type: rcc, normal_stiffness: {}, tangential_stiffness: 5e8 Pa/m, work_of_adhesion: {}, healing: 1e-2 1/(Pa s), saturation: 10 kPa}}
solver: {{type: projected_newton, tolerance: 1e-8}}
)yaml",
                            slip, stiffness, work));
    double pull = 0, healed = 0, slip_left = 0;
    while (!run.stepper.finished()) {
      const StepReport r = run.step();
      healed += r.flows.of("work_healing");
      if (r.time > 0.1) pull = std::max(pull, -run.world->bonds->force_between(run.state().x, LawTerm::all, {1, 0}).y());
      else slip_left = run.world->bonds->openings(run.state().x).empty() ? 0 : std::sqrt(run.world->bonds->openings(run.state().x).front().s);
    }
    // The slip that remains at the end is shear that the old bonds still carry. With this shear the onset is reached a little sooner.
    const double intensity = 0.675 * (1 - std::exp(-100 * 0.08)), most = intensity * std::sqrt(intensity * work * stiffness);
    const double along = work / intensity - 5e8 * slip_left * slip_left;
    CHECK(pull == Approx(area * intensity * intensity * std::sqrt(stiffness * along)).epsilon(0.06));
    CHECK(pull > 0.75 * area * most);
    CHECK(healed <= 0);
    CHECK(healed > -work * area);
  }
}
