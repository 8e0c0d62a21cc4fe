// The interactions of docs/extending.md against closed forms.
#include <catch2/catch.hpp>
#include <numbers>

#include "framework/checks/derivative_check.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

std::string hung(const std::string& reel, const std::string& gravity) {
  return "time: {step: 20 ms, duration: 1 s, integrator: quasi_static}\ngravity: " + gravity + "\nsolver: {type: projected_newton, tolerance: 1e-8}\nobjects:\n"
         "  - {name: bar, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 1, 0]}, motion: [fixed]}\n"
         "  - {name: crate, shape: {type: box, size: [0.1, 0.1, 0.1]}, body: {type: affine, density: 1000}, motion: [{type: fixed, across: [0, 1, 0]}]}\n"
         "interactions: [{type: documented_tether, from: bar, start: [0, 0.95, 0], to: crate, end: [0, 0.05, 0], stiffness: 1 kN/m, reel: " + reel + "}]\n";
}

// Returns the height of the crate above its start [m].
double height(TestRun& run, double until) {
  while (run.state().time < until - 1e-9) run.step();
  return run.world->centre_of_mass(1, run.state().x).y();
}

// Along x, 10 cm long and 1 cm wide.
std::string bar(const std::string& moisture, const std::string& time, double young) {
  return time + "\nsolver: {type: projected_newton, tolerance: 1e-8}\nobjects:\n"
         "  - {name: bar, shape: {type: box, size: [0.1, 0.01, 0.01], cells: [20, 1, 1]}, energies: [{type: neo_hookean, young: " + std::to_string(young) +
         ", poisson: 0, density: 1000}]}\ninteractions: [{type: documented_moisture, name: water, object: bar, " + moisture + "}]\n";
}

std::vector<double> moisture(const TestRun& run) {
  const UnknownGroup& group = run.world->unknowns.at(0);
  std::vector<double> all;
  for (const int v : group.vertices) all.push_back(run.state().x(3 * v) / group.length);
  return all;
}

}  // namespace

TEST_CASE("the documented rope stretches by weight over stiffness, is reeled in, and hangs slack", "[documented][interactions]") {
  TestRun still(hung("1", "[0, -9.81, 0]"));
  CHECK(height(still, 0.1) == Approx(-9.81e-3).epsilon(1e-4));
  TestRun reeled(hung("[[0 s, 1], [0.5 s, 0.8]]", "[0, -9.81, 0]"));
  CHECK(height(reeled, 0.6) == Approx(0.2 * 0.9 - 9.81e-3).epsilon(1e-4));
  TestScene checked(hung("0.9", "[0, -9.81, 0]"));
  for (const DerivativeCheck& check : check_derivatives(*checked.world, 0.01, checked.clock)) CHECK_FALSE(check.wrong());
  // Nothing else acts, and the rope is longer than it need be.
  std::string slack = hung("1.5", "[0, 0, 0]");
  slack.replace(slack.find("quasi_static"), 12, "implicit_euler");
  TestRun run(slack);
  CHECK(std::abs(height(run, 0.1)) < 1e-15);
}

TEST_CASE("reeling in the documented rope is work, without numerical energy gain", "[documented][interactions]") {
  std::string scene = hung("[[0 s, 1], [0.3 s, 0.7]]", "[0, -9.81, 0]");
  scene.replace(scene.find("quasi_static"), 12, "newmark");
  scene.replace(scene.find("20 ms"), 5, "2 ms");
  TestRun run(scene);
  double work = 0;
  while (run.state().time < 0.5) work += run.step().flows.of("work_ropes");
  const double rise = run.world->centre_of_mass(1, run.state().x).y();
  CHECK(rise > 0.2);
  const double motion = 0.5 * std::pow(run.state().v(3 * run.world->bodies[1].frame[0] + 1), 2), stretch = run.world->interactions[0].terms[0]->value(run.state().x);
  CHECK(work == Approx(9.81 * rise + motion + stretch).epsilon(0.01));  // of 1 kg
  CHECK_FALSE(warned(run.warnings, WarningKind::energy_growth));
}

TEST_CASE("the documented moisture swells a body by its fraction of the volume", "[documented][interactions]") {
  TestRun run(bar("modulus: 1e6, swelling: 0.331, diffusivity: 1e-6, capacity: 1e3, wet: {type: all}, level: [[0 s, 0], [1 s, 1]]",
                  "time: {step: 50 ms, duration: 2 s, integrator: quasi_static}", 10));
  while (run.state().time < 1.2) run.step();
  double volume = 0;
  for (const Tet& t : run.world->bodies[0].tets) {
    const auto c = corners(run.state().x, t);
    volume += (c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]) / 6;
  }
  CHECK(volume == Approx(1.331e-5).epsilon(1e-4));
}

TEST_CASE("the documented moisture follows the diffusion equation", "[documented][interactions]") {
  const double diffusivity = 1e-3, length = 0.1, until = 2;
  TestRun run(bar("modulus: 1e3, swelling: 0, diffusivity: 1e-3, capacity: 1e3, wet: {type: face, direction: [-1, 0, 0]}, level: 1",
                  "time: {step: 20 ms, duration: 5 s}", 1e4));
  double dissipated = 0;
  while (run.state().time < until - 1e-9) dissipated += run.step().flows.of("dissipated_soaking");
  const std::vector<double> c = moisture(run);
  double worst = 0;
  for (size_t v = 0; v < c.size(); ++v) {
    const double at = run.rest(static_cast<int>(v)).x() + length / 2;
    double exact = 1;
    for (int n = 0; n < 50; ++n) {
      const double k = (n + 0.5) * std::numbers::pi / length;
      exact -= 2 / (k * length) * std::sin(k * at) * std::exp(-diffusivity * k * k * run.state().time);
    }
    worst = std::max(worst, std::abs(c[v] - exact));
  }
  CHECK(worst < 5e-3);
  CHECK(*std::min_element(c.begin(), c.end()) < 0.7);
  CHECK(dissipated > 0);
}

TEST_CASE("a squeezed body dries", "[documented][interactions]") {
  std::string scene = bar("modulus: 1e5, swelling: 1, diffusivity: 1e-4, capacity: 1e3", "time: {step: 20 ms, duration: 5 s}", 1e5);
  const std::string motion = ", motion: [{type: fixed, select: {type: face, direction: [-1, 0, 0]}}, {type: translate, displacement: [-0.01, 0, 0], duration: 1 s, select: {type: face, direction: "
                             "[1, 0, 0]}}]";
  scene.insert(scene.find("}\ninteractions"), motion);
  TestRun run(scene);
  while (run.state().time < 1) run.step();
  for (const double c : moisture(run)) CHECK(c < -0.01);
}
