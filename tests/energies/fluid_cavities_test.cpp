// Fluid cavities between objects: volume, pressure, and the leak through slits.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

#include "framework/load/volume_term.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

constexpr double outside = 101325;  // Pa

// Two sheets of 2 x 2, one above the other, from `below` to `above`, formulas of x and z; in units of `unit`.
std::string sheets(double unit, int cells, const std::string& below, const std::string& above, const std::string& filling, const std::string& more = "") {
  const auto sheet = [&](const char* name, const std::string& height, const std::string& motion) {
    return fmt::format("  - {{name: {}, shape: {{type: warped, of: {{type: grid, size: [{}, {}], cells: [{}, {}]}}, y: '{}'}}, shell: {{thickness: {}}},\n"
                       "     energies: [{{type: neo_hookean_membrane, young: 1 MPa, density: 1000}}]{}}}\n",
                       name, 2 * unit, 2 * unit, cells, cells, height, 0.01 * unit, motion);
  };
  return "objects:\n" + sheet("low", below, ", motion: [fixed]") + sheet("high", above, more) +
         fmt::format("  - {{name: far, shape: {{type: box, size: [{0}, {0}, {0}]}}, place: {{translate: [{1}, 0, 0]}}, body: affine}}\n", 0.1 * unit, 9 * unit) +
         "interactions:\n  - {type: chamber, name: air, parts: [{object: low}, {object: high}], content: " + filling + "}\n";
}

const VolumeTerm& chamber_of(const World& world) {
  REQUIRE(world.cavities.size() == 1);
  return *world.cavities.front();
}

Vec3 force_on(const World& world, int body, const VecX& x) {
  const VecX gradient = dense_gradient(chamber_of(world), x);
  Vec3 sum = Vec3::Zero();
  for (const int v : world.vertices_of(body)) sum -= vertex(gradient, v);
  return sum;
}

}  // namespace

TEST_CASE("fluid cavities: two sheets enclose one volume, and its pressure acts on both areas", "[loads]") {
  for (const double unit : {1e-3, 1.0, 1e3}) {
    INFO(unit);
    const double gap = 0.5 * unit, area = 4 * unit * unit, pressure = 1.25 * outside;
    TestRun run("time: {step: 1 ms, duration: 1}\n" + sheets(unit, 3, "0", fmt::format("{}", gap), fmt::format("{{type: gas, pressure: {}}}", pressure)) +
                "probes: [{name: v, type: chamber, chamber: air, quantity: volume}, {name: p, type: chamber, chamber: air}]\n");
    World& world = *run.world;
    CHECK(run.sample(0).front() == Approx(area * gap).epsilon(1e-12));
    CHECK(run.sample(1).front() == Approx(pressure - outside).epsilon(1e-12));
    world.participants.load_history({});
    VecX x = world.start.x;
    world.participants.begin_step({x, 0, 0});
    const double first = (pressure - outside) * area;
    CHECK((force_on(world, 0, x) + first * Vec3::UnitY()).norm() < 1e-10 * first);
    CHECK((force_on(world, 1, x) - first * Vec3::UnitY()).norm() < 1e-10 * first);
    // At twice the distance p V is unchanged, whichever side moves.
    for (const int v : world.vertices_of(1)) vertex(x, v).y() += gap;
    CHECK(chamber_of(world).volume(x) == Approx(2 * area * gap).epsilon(1e-12));
    const double second = (pressure / 2 - outside) * area;
    CHECK((force_on(world, 1, x) - second * Vec3::UnitY()).norm() < 1e-10 * std::abs(second));
  }
}

TEST_CASE("fluid cavities: the volume between curved sheets converges", "[loads]") {
  // h (1 - x^2) (1 - z^2) on both sides of the slit: 2 h 16/9, and what is between the rims.
  const double rim = 0.02, height = 0.3, exact = 2 * height * 16 / 9 + 2 * rim * 4;
  double error[3];
  for (int k = 0; k < 3; ++k) {
    const std::string bulge = fmt::format("({} + {} * (1 - x^2) * (1 - z^2))", rim, height);
    TestRun run("time: {step: 1 ms, duration: 1}\n" + sheets(1, 4 << k, "-" + bulge, bulge, "{type: gas}") +
                "probes: [{name: v, type: chamber, chamber: air, quantity: volume}]\n");
    error[k] = std::abs(run.sample(0).front() / exact - 1);
  }
  CHECK(error[1] == Approx(error[0] / 4).epsilon(0.15));
  CHECK(error[2] == Approx(error[1] / 4).epsilon(0.15));
  CHECK(error[2] < 0.01);
}

// The upper sheet rises within ten steps to so many gaps, and stands there: of the pressure above the ambient one, vent times the open area over the
// volume leaves in a second, where the sides of the chamber, 4 a g of area, are open by what is more than twice that at rest.
TEST_CASE("fluid cavities: the content leaks through open slits at the speed of vent", "[loads]") {
  const double speed = 3, rate_of = 4 * speed / 2;  // of sheets of side 2: times 1 - 2 g0 / g
  for (const double unit : {1e-3, 1.0, 1e3})
    for (const auto& [filling, over] : {std::pair<std::string, double>("{type: gas, pressure: 400 kPa}", 1), {"{type: gas}", -1}, {"{type: liquid, bulk_modulus: 1 MPa}", -1}})
      for (const double gaps : {1.9, 3.0, 5.0}) {
        INFO(unit << " " << filling << " " << gaps);
        const double gap = 0.25 * unit;
        const bool gas = filling.find("gas") != filling.npos;
        TestRun run("time: {step: 10 ms, duration: 1}\n" +
                    sheets(unit, 2, "0", fmt::format("{}", gap), filling + fmt::format(", vent: {}", speed * unit),
                           fmt::format(", motion: [{{type: keyframes, frames: [{{time: 0}}, {{time: 0.1, translation: [0, {}, 0]}}]}}]", (gaps - 1) * gap)) +
                    (gas ? "probes: [{name: p, type: chamber, chamber: air}, {name: m, type: chamber, chamber: air, quantity: amount}]\n"
                         : "probes: [{name: p, type: chamber, chamber: air}]\n"));
        for (int i = 0; i < 10; ++i) run.step();
        const double before = run.sample(0).front(), rate = rate_of * std::max(0.0, 1 - 2 / gaps);
        if (gaps == 1.9) CHECK(before * over > 0);
        if (gaps == 1.9 && gas) CHECK(run.sample(1).front() == 1);
        for (int i = 0; i < 20; ++i) run.step();
        CHECK(run.sample(0).front() == Approx(before * std::exp(-rate * 0.2)).epsilon(1e-9));
        // Isothermal gas: p V = m p0 V0.
        if (gas) CHECK(run.sample(1).front() == Approx((run.sample(0).front() + outside) * gaps / (over > 0 ? 400e3 : outside)).epsilon(1e-9));
      }
}

TEST_CASE("fluid cavities: a vent without slits, or with a prescribed pressure, is refused", "[loads]") {
  const auto chamber = [](const std::string& parts, const std::string& more) {
    return "time: {step: 1 ms, duration: 1}\nobjects:\n  - {name: ball, shape: {type: sphere, radius: 0.1, cells: 4, surface: true}, shell: {thickness: 1 mm}, "
           "energies: [{type: neo_hookean_membrane, young: 1 MPa, density: 1000}]}\ninteractions:\n  - {type: chamber, name: air, parts: [" +
           parts + "], " + more + "}\n";
  };
  CHECK_THROWS_WITH(TestRun(chamber("{object: ball}", "content: {type: gas}, vent: 1")), Catch::Contains("no slits between its parts"));
  CHECK_THROWS_WITH(TestRun(chamber("{object: ball}", "content: {type: pressure, value: 1 kPa}, vent: 1")), Catch::Contains("does not fall"));
}
