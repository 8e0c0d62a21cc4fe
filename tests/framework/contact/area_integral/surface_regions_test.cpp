// Pairs of surface regions: laws between selections of objects.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "framework/bond/bond_term.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/contact/area_integral/overlap_boundary_forces.hpp"
#include "framework/contact/area_integral/overlap_boundary_term.hpp"
#include "tests/support/published.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

constexpr double gap = 0.8e-3;  // m

// Two plates of 2 x 2 cm in units of `unit`, one above the other; the upper one is shifted along x.
struct Plates {
  std::array<int, 2> cells = {4, 4};
  std::string pairs = {};
  double unit = 1, shift = 0, height = gap;
  std::string shape = "box";  // or sheet
  std::string more = {};      // loads and motions of the upper one

  std::string yaml() const {
    const auto plate = [&](const char* name, int n, double x, double y, const std::string& rest) {
      const double side = 0.02 * unit;
      const std::string mesh = shape == "box" ? fmt::format("{{type: box, size: [{0}, {1}, {0}], cells: [{2}, 1, {2}]}}", side, 0.005 * unit, n)
                                              : fmt::format("{{type: grid, size: [{0}, {0}], cells: [{1}, {1}]}}, shell: {{thickness: {2}}}", side, n, 1e-3 * unit);
      const std::string material = shape == "box" ? "neo_hookean" : "neo_hookean_membrane";
      return fmt::format("  - {{name: {}, shape: {}, place: {{translate: [{}, {}, 0]}}, energies: [{{type: {}, young: 2e7, density: 10}}]{}}}\n", name, mesh, x * unit, y * unit, material, rest);
    };
    const double half = shape == "box" ? 0.0025 : 0;
    return "objects:\n" + plate("upper", cells[0], shift, half + height, more) + plate("lower", cells[1], 0, -half, "") +
           fmt::format("contact:\n  distance: {}\n  pairs: [{}]\n", 0.05e-3 * unit, pairs);
  }
};

std::string law(double unit, double peak = 1000) { return fmt::format("adhesion: {{type: fang, peak_traction: {}, peak_distance: {}, range: {}}}", peak, 1e-3 * unit, 2e-3 * unit); }

// By which the upper plate is pulled down [N].
double pull(const Plates& plates) {
  TestScene scene(plates.yaml());
  World& world = *scene.world;
  world.participants.begin_step({world.rest, 0, 1e-3});
  world.participants.move_to(world.rest);
  return -contact_term(world).force_between(world.rest, LawTerm::adhesion, {0, 1}).y();
}

std::string half(const char* object, const char* along, double unit) { return fmt::format("{{object: {}, select: {{type: formula, where: '{} < {}'}}}}", object, along, 1e-6 * unit); }

double cells_below_zero(int cells) { return cells / 2 / double(cells); }

}  // namespace

TEST_CASE("regions: a half that adheres pulls with half the force, whatever the meshes, the unit and the side that is named", "[contact][regions]") {
  for (const double unit : {1e-3, 1.0, 1e3})
    for (const char* shape : {"box", "sheet"})
      for (const std::array<int, 2> cells : {std::array{4, 4}, std::array{4, 6}, std::array{10, 4}, std::array{7, 4}, std::array{4, 7}}) {
        INFO(unit << " " << shape << " " << cells[0] << " on " << cells[1]);
        const auto force = [&](const std::string& between) {
          return pull({.cells = cells, .pairs = "{between: [" + between + "], " + law(unit) + "}", .unit = unit, .shape = shape});
        };
        const double whole = force("upper, lower"), upper = cells_below_zero(cells[0]), lower = cells_below_zero(cells[1]);
        CHECK(whole == Approx(1000 * gap / 1e-3 * 4e-4 * unit * unit).epsilon(1e-9));
        CHECK(force("{object: upper, select: all}, lower") == Approx(whole).epsilon(1e-9));
        CHECK(force(half("upper", "x", unit) + ", lower") == Approx(upper * whole).epsilon(1e-6));
        CHECK(force("upper, " + half("lower", "x", unit)) == Approx(lower * whole).epsilon(1e-6));
        CHECK(force(half("lower", "x", unit) + ", \"*\"") == Approx(lower * whole).epsilon(1e-6));
        CHECK(force(half("upper", "x", unit) + ", " + half("lower", "x", unit)) == Approx(std::min(upper, lower) * whole).epsilon(1e-6));
        CHECK(force(half("upper", "x", unit) + ", " + half("lower", "z", unit)) == Approx(upper * lower * whole).epsilon(1e-6));
      }
}

TEST_CASE("regions: the surface outside has the law of the object, and the more specific entry holds", "[contact][regions]") {
  const std::string left = "{between: [" + half("upper", "x", 1) + ", lower], " + law(1, 3000) + "}", all = "{between: [upper, lower], " + law(1, 1000) + "}",
                    corner = "{between: [" + half("upper", "x", 1) + ", " + half("lower", "z", 1) + "], " + law(1, 5000) + "}", any = "{between: [\"*\", \"*\"], " + law(1, 7000) + "}";
  const double unit_force = pull({.pairs = all});
  CHECK(pull({.pairs = left + ", " + all}) == Approx(2 * unit_force).epsilon(1e-6));
  CHECK(pull({.pairs = all + ", " + corner + ", " + left}) == Approx((0.5 + 0.25 * 5 + 0.25 * 3) * unit_force).epsilon(1e-6));
  CHECK(pull({.pairs = any + ", " + left}) == Approx((0.5 * 7 + 0.5 * 3) * unit_force).epsilon(1e-6));
  // A pair of two named objects is more specific than a pair of one object and all.
  CHECK(pull({.pairs = "{between: [" + half("upper", "x", 1) + ", \"*\"], " + law(1, 3000) + "}, " + all}) == Approx(unit_force).epsilon(1e-9));
  // The general contact beside a region that adheres, and a region without adhesion in an object that adheres.
  CHECK(pull({.pairs = all + ", {between: [" + half("upper", "x", 1) + ", lower], friction: {mu: 0.1}}"}) == Approx(0.5 * unit_force).epsilon(1e-6));
}

TEST_CASE("regions: an interface is an overlap boundary: its forces are minus the gradient of the energy with re-evaluated areas", "[contact][regions][overlap_boundary]") {
  for (const std::array<int, 2> cells : {std::array{6, 5}, std::array{3, 8}})
    for (const double shift : {0.0021, 0.0071})
      for (const std::string& pairs : {"{between: [upper, " + half("lower", "x", 1) + "], " + law(1) + "}",
                                       "{between: [" + half("upper", "z", 1) + ", " + half("lower", "x", 1) + "], " + law(1, 2000) + "}, {between: [upper, lower], " + law(1, 700) + "}"}) {
        INFO(cells[0] << " on " << cells[1] << ", shift " << shift << ": " << pairs);
        TestScene scene(Plates{.cells = cells, .pairs = pairs, .shift = shift, .more = ""}.yaml());
        World& world = *scene.world;
        const auto begin = [&](const VecX& x) {
          world.participants.begin_step({x, 0, 1e-3});
          world.participants.move_to(x);
        };
        const auto energy = [&](const VecX& x) { return begin(x), contact_term(world).value(x); };
        VecX x = world.rest;
        std::mt19937 generator(1);
        std::uniform_real_distribution<double> component(-1, 1);
        const VecX d = VecX::NullaryExpr(x.size(), [&] { return component(generator); });
        // Beside the lines of the meshes.
        for (int v = 0; v < world.bodies[0].vertex_count; ++v) x(3 * v + 2) += 0.00073;
        begin(x);
        const VecX f = contact_term(world).forces(x, LawTerm::all) + overlap_boundary_forces(world, x);
        const double step = 1e-8, slope = (energy(x + step * d) - energy(x - step * d)) / (2 * step);
        CHECK(-f.dot(d) == Approx(slope).epsilon(4e-3).scale(0.6 * 0.02));
        // The total is the energy of the strip that comes under the interface.
        if (world.adhesion.size() > 1) continue;
        begin(x);
        const double depth = -world.contact->pairs().laws(LawTerm::all)[world.contact->pairs().point(0, 1, 0).law].at(gap).value;
        const double seam = cells[1] == 5 ? -0.002 : 0;
        CHECK(0.01 + seam > shift - 0.01);
        CHECK(overlap_boundary_force(world, x, "adhesion", {0, 1}).x() == Approx(-depth * (0.02 - 0.00073)).epsilon(0.01));
      }
}

// A slab that slides on a floor, with friction under half of its width, without a moment about the direction of sliding.
TEST_CASE("regions: friction under half of a block slows it by half", "[contact][regions]") {
  const auto deceleration = [](double unit, const std::string& pairs) {
    TestRun run(fmt::format("time: {{step: 5 ms, duration: 1}}\ngravity: [0, {1}, 0]\nsolver: {{tolerance: {2}}}\nobjects:\n"
                            "  - {{name: block, shape: {{type: box, size: [{3}, {4}, {3}], cells: [8, 1, 8]}}, place: {{translate: [0, {5}, 0]}}, body: {{type: affine, density: 1000}}, velocity: [{0}, 0, 0]}}\n"
                            "  - {{name: floor, shape: {{type: box, size: [{6}, {4}, {3}], cells: [16, 1, 8]}}, place: {{translate: [0, -{7}, 0]}}, motion: [fixed]}}\n"
                            "contact:\n  distance: {8}\n  friction: {{mu: 0, eps_v: {9}}}\n  pairs: [{10}]\n",
                            0.5 * unit, -9.81 * unit, 1e-6 * unit, 0.1 * unit, 0.01 * unit, 0.0054 * unit, 0.3 * unit, 0.005 * unit, 0.5e-3 * unit, 1e-3 * unit, pairs));
    for (int i = 0; i < 4; ++i) run.step();
    const double before = run.state().v(0);
    for (int i = 0; i < 10; ++i) run.step();
    CHECK(std::abs(run.state().v(2)) < 1e-3 * unit);
    return (before - run.state().v(0)) / 0.05 / unit;
  };
  const std::string mu = "friction: {mu: 0.3, eps_v: ", middle = "{object: block, select: {type: formula, where: 'abs(z) < ";
  for (const double unit : {1e-3, 1.0, 1e3}) {
    INFO(unit);
    const std::string rubs = mu + fmt::format("{}}}}}", 1e-3 * unit), part = middle + fmt::format("{}'}}}}", 0.0251 * unit);
    CHECK(deceleration(unit, "{between: [block, floor], " + rubs) == Approx(0.3 * 9.81).epsilon(0.02));
    CHECK(deceleration(unit, "{between: [" + part + ", floor], " + rubs) == Approx(0.15 * 9.81).epsilon(0.02));
  }
}

TEST_CASE("regions: bonds form where an entry names them, by its law, and are kept by a state", "[contact][regions][bonds]") {
  const std::string rcc = "adhesion: {type: rcc, normal_stiffness: 1e8, tangential_stiffness: 5e7, work_of_adhesion: ";
  const std::string left = "{between: [" + half("upper", "x", 1) + ", lower], " + rcc + "1}, bond_distance: 0.1 mm}";
  const std::string right = "{between: [{object: upper, select: {type: formula, where: 'x > -1e-6'}}, " + half("lower", "z", 1) + "], " + rcc + "2}, bond_distance: 0.1 mm}";
  for (const char* shape : {"box", "sheet"})
    for (const std::array<int, 2> cells : {std::array{4, 6}, std::array{6, 4}}) {
      INFO(shape << " " << cells[0] << " on " << cells[1]);
      const std::string yaml = "time: {step: 1 ms, duration: 1}\n" + Plates{.cells = cells, .pairs = left + ", " + right, .height = 0.04e-3, .shape = shape}.yaml() +
                               "probes: [{name: bonded, type: bonds, between: [upper, lower], quantity: area}]\n";
      TestRun run(yaml);
      run.step();
      CHECK(run.sample(0).front() == Approx(3e-4).epsilon(0.01));
      double of_rule[2] = {0, 0};
      const BondTerm& bonds = *run.world->bonds;
      REQUIRE(bonds.table().rules().size() == 2);
      for (const Bond& bond : bonds.list().bonds()) of_rule[bond.rule] += bond.area;
      // Two parts before one.
      CHECK(of_rule[0] == Approx(1e-4).epsilon(0.01));
      CHECK(of_rule[1] == Approx(2e-4).epsilon(0.01));
      History history;
      run.world->participants.commit(run.state().x, history);
      TestRun again(yaml);
      again.world->participants.load_history(history);
      REQUIRE(again.world->bonds->list().size() == bonds.list().size());
      for (int i = 0; i < bonds.list().size(); ++i) CHECK(again.world->bonds->list().bonds()[i].rule == bonds.list().bonds()[i].rule);
    }
}

// Objects above the region adhere, objects above the rest fall.
TEST_CASE("regions: particles and rods adhere to a region of a surface", "[contact][regions]") {
  for (const char* what : {"shape: {type: points, size: [0.01, 0, 0], counts: [2, 1, 1]}, particle: {radius: 1 mm}, energies: [{type: particle, density: 1000}]",
                           "shape: {type: segment, length: 0.01, edges: 1}, rod: {radius: 1 mm}, energies: [{type: elastic_rod, young: 1 GPa, density: 1000}]"}) {
    INFO(what);
    TestScene scene("objects:\n  - {name: dust, contact_offset: 1 mm, " + std::string(what) +
                    ", place: {translate: [0.02, 1.8e-3, 0]}}\n  - {name: more, contact_offset: 1 mm, " + what +
                    ", place: {translate: [-0.02, 1.8e-3, 0]}}\n"
                    "  - {name: plate, shape: {type: grid, size: [0.1, 0.1], cells: [8, 8]}, shell: {thickness: 1 mm}, motion: [fixed]}\n"
                    "contact:\n  distance: 0.05 mm\n  pairs: [{between: [" + half("plate", "x", 1) + ", \"*\"], " + law(1) + "}]\n");
    World& world = *scene.world;
    world.participants.begin_step({world.rest, 0, 1e-3});
    world.participants.move_to(world.rest);
    CHECK(contact_term(world).force_between(world.rest, LawTerm::adhesion, {0, 2}).norm() == 0);
    CHECK(contact_term(world).force_between(world.rest, LawTerm::adhesion, {1, 2}).y() < 0);
  }
}
