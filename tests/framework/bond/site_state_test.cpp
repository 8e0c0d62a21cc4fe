// Laws that depend on the state of their site: temperature, time, objects and the direction of the slip, in a world.
#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include "framework/bond/bond_term.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

std::string plate(const std::string& name, const std::string& at, const std::string& more) {
  return "  - {name: " + name + ", shape: {type: box, size: [0.02, 0.002, 0.02], cells: [3, 1, 4]}, place: {translate: " + at + "}, energies: [{type: neo_hookean, young: 1e9, density: 1000}]" + more + "}\n";
}

// Two plates, 0.8 mm apart.
std::string plates(const std::string& law, const std::string& environment, const std::string& motion = "") {
  return "objects:\n" + plate("lower", "[0, 0, 0]", motion.empty() ? "" : ", motion: [fixed]") + plate("upper", "[0.005, 0.0028, 0]", motion) +
         "contact:\n  distance: 1e-3\n  barrier: {type: clamped_log, stiffness: 1e3}\n  pairs: [{between: [lower, upper], adhesion: " + law + "}]\n" + environment;
}

const std::string solid = "{type: viscoelastic, peak_traction: 1e4, work_of_adhesion: 1, stiffness: 1e8, branch_stiffness: 3e8, relaxation_time: 0.05, tangential_strength: 2e4}";
const std::string thermal = "{type: documented_thermal, stiffness: 1e7, work_of_adhesion: 1, softening: 20 K}";

VecX moved(const World& world, const VecX& x, const Vec3& way) {
  VecX y = x;
  const Body& b = world.bodies[world.body_index("upper")];
  for (int v = b.first_vertex; v < b.first_vertex + b.vertex_count; ++v) vertex(y, v) += way;
  return y;
}

// Begins and ends a step at x + way.
void step_to(World& world, VecX& x, const Vec3& way, double time, double h) {
  world.participants.begin_step({x, time, h});
  x = moved(world, x, way);
  world.bonds->commit(x, world.start.history);
  world.participants.load_history(world.start.history);
}

}  // namespace

TEST_CASE("directed bonds: gradient and Hessian are those of the value, whichever way the branch has flowed", "[bonds]") {
  TestScene scene(plates(solid, ""));
  World& world = *scene.world;
  VecX x = world.rest;
  world.participants.load_history(world.start.history);
  step_to(world, x, {2e-5, 3e-5, 1e-5}, 0, 0.03);
  world.participants.begin_step({x, 0.03, 0.02});
  RandomMotions random(3);
  const BondTerm& term = *world.bonds;
  REQUIRE(term.list().size() > 10);
  for (const Vec3& way : {Vec3(-4e-5, 2e-5, 3e-5), Vec3(2e-5, -1e-5, 0), Vec3(1e-5, 3e-5, -1e-5), Vec3(0, -6e-5, 0)}) {
    VecX y = moved(world, x, way);
    y += 2e-6 * random.vectors(y.size());
    const auto value = [&](const VecX& z) { return term.value(z); };
    const auto gradient = [&](const VecX& z) { return dense_gradient(term, z); };
    const VecX g = gradient(y);
    CHECK((g - gradient_by_differences(value, y, 1e-8)).norm() < 1e-5 * g.norm());
    const MatX h = dense_hessian(term, y, Projection::none), differences = hessian_by_differences(gradient, y, 1e-9);
    CHECK((h - differences).norm() < 1e-4 * h.norm());
    CHECK(smallest_eigenvalue(dense_hessian(term, y, Projection::clamp)) > -1e-12 * h.norm());
  }
}

TEST_CASE("the branch of viscoelastic bonds pulls back in the direction in which it has flowed", "[bonds]") {
  TestScene scene(plates(solid, ""));
  World& world = *scene.world;
  VecX x = world.rest;
  world.participants.load_history(world.start.history);
  const double u = 1e-5, area = [&] {
    world.participants.begin_step({x, 0, 1e-3});
    double sum = 0;
    for (const Bond& b : world.bonds->list().bonds()) sum += b.area;
    return sum;
  }();
  step_to(world, x, {u, 0, 0}, 0, 1e3);  // all flows
  world.participants.begin_step({x, 1e3, 1e-9});
  const auto force = [&](const Vec3& way) {
    return Vec3(world.bonds->force_between(moved(world, x, way), LawTerm::adhesion, {world.body_index("upper"), world.body_index("lower")}) / area);
  };
  // K_T = 4 K, and 4 K_1 across: where it is, the spring alone; back at the start, the branch alone; across, both.
  CHECK(force({0, 0, 0}).x() == Approx(-4e8 * u).epsilon(1e-3));
  CHECK(force({-u, 0, 0}).x() == Approx(12e8 * u).epsilon(1e-3));
  CHECK(force({-u, 0, u}).x() == Approx(12e8 * u).epsilon(1e-3));
  CHECK(force({-u, 0, u}).z() == Approx(-16e8 * u).epsilon(1e-3));
  CHECK(force({-2 * u, 0, 0}).x() == Approx((4e8 + 2 * 12e8) * u).epsilon(1e-3));
}

TEST_CASE("bonds see temperature, time, objects and position of their site", "[bonds]") {
  TestScene scene(plates(thermal, "environment: {temperature: [[0, 290], [10, 310]], profile: k * x + 0.1 * t, parameters: {k: 100}}\n"));
  World& world = *scene.world;
  world.participants.load_history(world.start.history);
  world.participants.begin_step({world.rest, 4, 1});
  const BondTerm& term = *world.bonds;
  REQUIRE(term.list().size() > 10);
  for (int i = 0; i < term.list().size(); ++i) {
    const SiteState* site = term.site(i);
    REQUIRE(site);
    const Bond& bond = term.list().bonds()[i];
    CHECK(site->time == 5);
    CHECK(site->temperature == Approx(300 + 100 * site->rest_position.x() + 0.5));
    CHECK(site->objects == std::array{bond.a, bond.b});
    CHECK(site->names[0] == world.bodies[bond.a].name);
    CHECK(site->names[1] == world.bodies[bond.b].name);
    CHECK((site->rest_position - site->position).norm() < 1e-15);
    CHECK(site->normal.dot(bond.normal) == Approx(1));
    CHECK(site->slip.norm() < 1e-15);
    CHECK(site->tangents[0].cross(site->tangents[1]).dot(bond.normal) == Approx(1));
  }
}

TEST_CASE("warming that softens bonds is work of the environment, and the energy balance closes", "[bonds]") {
  // Opened by 0.1 mm in 1 s, then held while the bonds warm by 20 K.
  const std::string motion = ", motion: [{type: formula, y: \"1e-4 * min(t, 1)\", select: {type: face, direction: [0, 1, 0]}}]";
  TestRun run(plates(thermal, "environment: {temperature: [[1, 293.15], [2, 313.15]]}\ntime: {step: 0.1, duration: 2, integrator: quasi_static}\n", motion));
  double environment = 0, stored = 0, held = 0, area = 0;
  const auto bonds = [](const StepReport& r) {
    for (const NamedEnergy& e : r.energies)
      if (e.name == "bonds") return e.value;
    return 0.0;
  };
  for (int i = 0; i < 20; ++i) {
    const StepReport r = run.step();
    environment += r.flows.of("work_environment");
    stored = bonds(r);
    if (i == 9) held = stored;
    if (i >= 10) CHECK(std::abs(r.flows.numerics) < 1e-3 * stored);
  }
  for (const Bond& b : run.world->bonds->list().bonds()) area += b.area;
  // D = K d^2 / (4 W) = 0.025 does not grow any more.
  CHECK(held == Approx(area * (1 - 0.025) * 1e7 * 1e-8 / 2).epsilon(1e-3));
  CHECK(stored == Approx(held / std::exp(1.0)).epsilon(1e-3));
  CHECK(environment == Approx(stored - held).epsilon(1e-3));
}

TEST_CASE("a temperature that nothing reads, and one below zero, are refused", "[bonds]") {
  CHECK_THROWS_WITH(TestScene(plates("{type: bilinear, peak_traction: 1e4, work_of_adhesion: 1}", "environment: {temperature: 300}\n")),
                    Catch::Contains("no adhesion law or energy of the scene depends on the temperature") && Catch::Contains("environment"));
  CHECK_THROWS_WITH(TestScene(plates(solid, "environment: {temperature: 300}\n")), Catch::Contains("`viscoelastic` with `shift`"));
  CHECK_THROWS_WITH(TestScene(plates(thermal, "environment: {temperature: -3 degC, profile: q + 1}\n")), Catch::Contains("q"));
  CHECK_THROWS_WITH(TestScene(plates(thermal, "environment: {temperature: 30 mm}\n")), Catch::Contains("expects a temperature (K)"));
  CHECK_THROWS_WITH(TestScene(plates(thermal, "environment: {parameters: {k: 1}}\n")), Catch::Contains("profile"));
  TestScene cold(plates(thermal, "environment: {temperature: 3 K, profile: -5 * t}\n"));
  cold.world->participants.load_history(cold.world->start.history);
  CHECK_THROWS_WITH(cold.world->participants.begin_step({cold.world->rest, 0, 1}), Catch::Contains("the temperature is -2 K"));
}
