// Delamination of two bonded beams against beam theory: mode II, mode I and mixed-mode cracks on
// the fixtures of the standards. Sheets have no shear deformation, so the corrections of measured
// crack lengths (chi h of ASTM D6671) come from the bonds alone. The crack length is computed from
// the compliance of each mode, as in compliance calibration.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// Loads of both modes, deflections and energy release rate of beams with a crack of length a:
//     G_I = 12 (P_I a)^2 / (E b^2 h^3),       opening d_I = 8 P_I a^3 / (E b h^3)
//     G_II = 9 (P_II a)^2 / (16 E b^2 h^3),   deflection d_II = P_II (2 L^3 + 3 a^3) / (8 E b h^3)
// (Reeder and Crews 1990, Mixed-mode bending method for delamination testing; ASTM D6671).
struct Modes {
  double opening, shear;  // of I and II
  double sum() const { return opening + shear; }
  double mixity() const { return shear / sum(); }
};

// Two strips of length 2 L, thickness h, width b, with a crack of length a at the left end. They
// stand on supports at both ends. A lever pushes them down: its links are fixed to the upper strip at
// `first` and `second`, the load acts at `pushed` [m from the left end].
struct Beams {
  double first = 0, second = 0, pushed = 0;
  std::string side = "automatic";
  double work_opening = 0.5, work_shear = 1;  // J/m^2
  double strength = 2e5, shear_strength = 2e5;  // Pa
  int cells = 160;
  double half = 0.04, crack = 0.03, grown = 0.033, until = 0.038;  // L; a at the start, and where G is taken [m]
  double young = 1e9, thickness = 1e-3, width = 2e-3, gap = 6e-5;

  double stiffness() const { return young * width * std::pow(thickness, 3); }  // E b h^3
  // Mixed-mode toughness of Benzeggagh and Kenane, with the exponent 2.
  double toughness(double mixity) const { return work_opening + (work_shear - work_opening) * mixity * mixity; }

  // Loads of the modes on mixed-mode bending, for a load of 1 at the distance c from the middle.
  Modes loads() const {
    const double c = pushed - half;
    if (c == 0) return {0, 1};  // end-notched flexure: the strips touch, the first link is slack
    return {(3 * c - half) / (4 * half), (c + half) / half};
  }
  Modes rates(const Modes& load, const Modes& length) const {
    return {12 * std::pow(load.opening * length.opening, 2) / (stiffness() * width),
            9 * std::pow(load.shear * length.shear, 2) / (16 * stiffness() * width)};
  }
  Modes deflections(const Modes& load, double a) const {
    return {8 * load.opening * std::pow(a, 3) / stiffness(),
            load.shear * (2 * std::pow(half, 3) + 3 * std::pow(a, 3)) / (8 * stiffness())};
  }
  // Crack lengths from the load and the deflections.
  Modes lengths(const Modes& load, const Modes& deflection) const {
    const double squeezed = 8 * stiffness() * deflection.shear / load.shear;
    return {load.opening > 0 ? std::cbrt(deflection.opening * stiffness() / (8 * load.opening)) : 0,
            std::cbrt((squeezed - 2 * std::pow(half, 3)) / 3)};
  }
  // Largest load that a sharp crack of length a carries [N].
  double sharp_load(double a) const {
    const Modes at_one = rates(loads(), {a, a});
    return std::sqrt(toughness(at_one.mixity()) / at_one.sum());
  }
  // Displacement of the lever at the load, with a crack of length a.
  double lever_displacement(double a) const {
    const double load = sharp_load(a);
    const Modes one = loads(), d = deflections({load * one.opening, load * one.shear}, a);
    const double middle = d.shear - d.opening / 4;
    return middle * pushed / half + d.opening * (pushed - half) / half;
  }

  std::string at(double x) const { return fmt::format("select: {{type: formula, where: abs(x - {}) < {}}}", x, half / cells / 2); }
  std::string strip(const std::string& name, double from, double to, double y, double modulus, double offset, const std::string& motions) const {
    return fmt::format("  - name: {}\n    shape: {{type: grid, size: [{}, {}], cells: [{}, 1]}}\n    place: {{translate: [{}, {}, 0]}}\n"
                       "    shell: {{thickness: {}}}\n    contact_offset: {}\n"
                       "    energies: [{{type: stvk_membrane, young: {}, poisson: 0}}, {{type: hinge_bending, young: {}, poisson: 0}}]\n    motion:\n"
                       "      - {{type: fixed, along: [0, 0, 1]}}\n{}",
                       name, to - from, width, std::lround((to - from) * cells / (2 * half)), (from + to) / 2, y, thickness, offset, modulus, modulus, motions);
  }
  // Fast until shortly before the crack grows, then slowly from the displacement `grows` to `ends`.
  std::string scene(double grows, double ends, int steps) const {
    const double clearance = 0.02, offset = thickness / 2 - gap / 2, begin = std::min({first, second, pushed}), end = std::max({first, second, pushed});
    const std::string left = "select: {type: face, direction: [-1, 0, 0]}}\n", right = "select: {type: face, direction: [1, 0, 0]}}\n";
    const auto link = [&](const char* name, double x) {
      return fmt::format("  - {{type: spring, name: {}, from: {{object: up, {}}}, to: {{object: lever, {}}}, stiffness: 1e4}}\n", name, at(x), at(x));
    };
    const auto raised = [&](const char* name, double x) {
      return fmt::format("  - {{name: {}, type: separation, direction: [0, 1, 0], from: {{object: lo, {}, to: {{object: up, {}}}}}\n", name,
                         right.substr(0, right.size() - 1), at(x));
    };
    return "objects:\n" +
           strip("lo", 0, 2 * half, -thickness / 2, young, offset,
                 "      - {type: fixed, along: [0, 1, 0], " + left + "      - {type: fixed, along: [1, 0, 0], " + right + "      - {type: fixed, along: [0, 1, 0], " + right) +
           strip("up", 0, 2 * half, thickness / 2, young, offset, "") +
           strip("lever", begin, end, thickness / 2 + clearance, 1e3 * young, 0,
                 fmt::format("      - {{type: formula, y: \"-(t < 0.2 ? {} * t : {} + {} * (t - 0.2))\", along: [0, 1, 0], {}}}\n      - {{type: fixed, along: [1, 0, 0], {}}}\n",
                             5 * grows, grows, (ends - grows) / 0.8, at(pushed), at(pushed))) +
           fmt::format("time: {{step: {}, duration: 1, integrator: quasi_static}}\n"
                       "contact:\n  distance: {}\n  barrier: {{type: clamped_log, stiffness: 1 MPa}}\n  pairs:\n"
                       "    - between: [{{object: up, select: {{type: formula, where: x > {}}}}}, {{object: lo, select: {{type: formula, where: x > {}}}}}]\n"
                       "      integrate: {}\n      bond_distance: {}\n"
                       "      adhesion: {{type: bilinear, peak_traction: {}, work_of_adhesion: {}, tangential_strength: {}, mixed_mode: benzeggagh_kenane, tangential_work: {}}}\n"
                       "    - {{between: [up, up], contact: false}}\n    - {{between: [lo, lo], contact: false}}\n    - {{between: [lever, lever], contact: false}}\n",
                       1.0 / steps, gap * 5 / 6, crack - 1e-6, crack - 1e-6, side, gap * 1.3, strength, work_opening, shear_strength, work_shear) +
           "interactions:\n" + link("one", first) + link("two", second) +
           fmt::format("probes:\n  - {{name: load, type: reaction, object: lever, {}, direction: [0, -1, 0]}}\n", at(pushed)) + raised("end", 0) + raised("middle", half) +
           "  - {name: intact, type: bonds, between: [up, lo], quantity: intact_area}\n";
  }
};

struct Growth {
  double rate = 0, mixity = 0, largest_load = 0;  // mean G over the toughness, mean G_II / G; largest load
};

// Follows the crack from its first broken bond to `until`. rate_of: G over the toughness, and the
// mixity, from the load and the displacements of the strips at the end and in the middle.
template <class RateOf>
Growth follow(const Beams& beams, double grows, double ends, int steps, const RateOf& rate_of) {
  TestRun run(beams.scene(grows, ends, steps));
  const double apart = run.sample(1)[0], middle = run.sample(2)[0];
  Growth mean;
  int count = 0;
  while (run.state().time < 1 - 1e-9) {
    run.step();
    const double load = run.sample(0)[0], crack = 2 * beams.half - run.sample(3)[0] / beams.width;
    mean.largest_load = std::max(mean.largest_load, load);
    const auto [rate, mixity] = rate_of(load, run.sample(1)[0] - apart, run.sample(2)[0] - middle);
    if (crack < beams.grown || crack > beams.until) continue;
    mean.rate += rate, mean.mixity += mixity, ++count;
  }
  REQUIRE(count >= 5);
  mean.rate /= count, mean.mixity /= count;
  return mean;
}

// Mixed-mode bending: the end of the upper strip is drawn up as the middle is pushed down. The
// largest load is relative to that of a sharp crack of the first length.
Growth mixed_mode_bending(Beams beams, double lever, int steps = 25) {
  beams.second = beams.half, beams.pushed = beams.half + lever;
  Growth g = follow(beams, 0.85 * beams.lever_displacement(beams.crack), beams.lever_displacement(beams.until), steps, [&](double load, double end, double middle) {
    const Modes one = beams.loads(), loads{load * one.opening, load * one.shear};
    const Modes rates = beams.rates(loads, beams.lengths(loads, {end, end / 4 - middle}));
    return std::pair(rates.sum() / beams.toughness(rates.mixity()), rates.mixity());
  });
  g.largest_load /= beams.sharp_load(beams.crack);
  return g;
}

}  // namespace

TEST_CASE("end-notched flexure: a crack sheared open releases its work, whichever side integrates", "[bonds]") {
  double before = 0;
  for (const std::string side : {"lo", "up"}) {
    const Growth g = mixed_mode_bending({.side = side}, 0);
    INFO(side);
    CHECK(g.rate == Approx(1).epsilon(0.02));
    if (before > 0) CHECK(g.rate == Approx(before).epsilon(2e-3));
    before = g.rate;
  }
}

// Between the links the moment is M = P s / 2, s from a support to a link, wherever the crack ends:
// G = 9 M^2 / (4 E b^2 h^3) without any length (Martin and Davidson 1999, Mode II fracture toughness
// evaluation using a four point bend end notched flexure test).
TEST_CASE("four-point end-notched flexure: a load that stays as the crack grows, whichever side integrates", "[bonds]") {
  double before = 0;
  for (const std::string side : {"lo", "up"}) {
    const Beams beams{.first = 0.02, .second = 0.06, .pushed = 0.04, .side = side, .until = 0.055};
    const Growth g = follow(beams, 1e-3, 1.9e-3, 30, [&](double load, double, double) {
      const double moment = load * beams.first / 2;
      return std::pair(9 * moment * moment / (4 * beams.stiffness() * beams.width) / beams.work_shear, 1.0);
    });
    INFO(side);
    CHECK(g.rate == Approx(1).epsilon(0.02));
    if (before > 0) CHECK(g.rate == Approx(before).epsilon(2e-3));
    before = g.rate;
  }
}

TEST_CASE("mixed-mode bending: a crack releases its work, one for all modes, whichever side integrates", "[bonds]") {
  double before = 0;
  for (const std::string side : {"lo", "up"}) {
    const Growth g = mixed_mode_bending({.side = side, .work_opening = 0.6, .work_shear = 0.6}, 0.035);
    INFO(side);
    CHECK(g.mixity == Approx(0.5).epsilon(0.03));
    CHECK(g.rate == Approx(1).epsilon(0.03));
    if (before > 0) CHECK(g.rate == Approx(before).epsilon(2e-3));
    before = g.rate;
  }
}

// Bonds of Benzeggagh and Kenane dissipate the work of their own path of opening and slip. Its mixity
// is that of the load if both extend equally far ahead of the crack: slip by sqrt(E h G_II) / tau,
// opening by (E h^3 G_I / sigma^2)^(1/4).
TEST_CASE("mixed-mode bending: the work of Benzeggagh and Kenane at the mixity of the load", "[bonds]") {
  const auto [lever, mixity] = GENERATE(std::pair(0.086, 0.2), std::pair(0.035, 0.5), std::pair(0.0225, 0.8));
  INFO(mixity);
  const Growth g = mixed_mode_bending({.strength = 1e5, .shear_strength = 3e5}, lever, 40);
  CHECK(g.mixity == Approx(mixity).margin(0.03));
  CHECK(g.rate == Approx(1).epsilon(0.03));
}

// Slip that extends three times as far as the opening dissipates more, but less than pure shear.
TEST_CASE("mixed-mode bending: bonds that slip far ahead of the crack spend more than the mixity of the load says", "[bonds]") {
  const Beams beams{};
  const Growth g = mixed_mode_bending(beams, 0.035);
  CHECK(g.rate > 1.05);
  CHECK(g.rate < beams.work_shear / beams.toughness(g.mixity));
}

// A sharp crack of the first length carries the largest load. Debonding extends over a length in
// proportion to 1 / strength, by which the crack is longer before it grows.
TEST_CASE("end-notched flexure: the largest load tends to that of a sharp crack as the strength grows", "[bonds]") {
  const auto missing = [](double strength, int cells) {
    const Beams beams{.strength = strength, .shear_strength = strength, .cells = cells};
    return 1 - mixed_mode_bending(beams, 0).largest_load;
  };
  const double weak = missing(1e5, 80), middle = missing(2e5, 160), strong = missing(4e5, 160);
  CHECK(weak < 0.16);
  CHECK(middle < 0.6 * weak);
  CHECK(strong < 0.65 * middle);
  CHECK(strong > 0);
}

// Before the crack grows, the arm is a beam on an elastic foundation behind the root of the crack:
// opening / load = a^3 / (3 E I) (1 + 3/m + 3/m^2 + 3/(2 m^3)), m = a (k / (4 E I))^(1/4), k = K b.
TEST_CASE("double cantilever: the root of the crack is as stiff as a beam on springs", "[bonds]") {
  const double young = 135.3e9, width = 5e-3, thickness = 1.5e-3, crack = 30e-3, strength = 57e6, onset = 0.5e-6, displacement = 4e-5;
  TestRun run("objects:\n"
              "  - {name: middle, shape: {type: grid, size: [0.03, 0.006]}, place: {translate: [0.015, 0, 0]}, motion: [fixed]}\n"
              "  - name: arm\n    shape: {type: grid, size: [0.06, 0.005], cells: [240, 2]}\n    place: {translate: [0, 20e-6, 0]}\n"
              "    shell: {thickness: 1.5e-3}\n"
              "    energies: [{type: stvk_membrane, young: 135.3e9, poisson: 0}, {type: hinge_bending, young: 135.3e9, poisson: 0}]\n    motion:\n"
              "      - {type: formula, y: 4e-5 * t, along: [0, 1, 0], select: {type: face, direction: [-1, 0, 0]}}\n"
              "      - {type: fixed, select: {type: face, direction: [1, 0, 0]}}\n      - {type: fixed, along: [0, 0, 1]}\n"
              "time: {step: 1, duration: 1, integrator: quasi_static}\n"
              "contact:\n  distance: 20e-6\n  pairs:\n"
              "    - {between: [arm, middle], bond_distance: 22e-6, adhesion: {type: bilinear, peak_traction: 57e6, work_of_adhesion: 140, onset: 0.5e-6}}\n"
              "    - {between: [arm, arm], contact: false}\n"
              "probes:\n  - {name: load, type: reaction, object: arm, select: {type: face, direction: [-1, 0, 0]}, direction: [0, 1, 0]}\n");
  while (run.state().time < 1 - 1e-9) run.step();
  const double bending = young * width * std::pow(thickness, 3) / 12, m = crack * std::pow(strength / onset * width / (4 * bending), 0.25);
  const double stiffness = 3 * bending / std::pow(crack, 3) / (1 + 3 / m + 3 / (m * m) + 1.5 / (m * m * m));
  CHECK(run.sample(0)[0] / displacement == Approx(stiffness).epsilon(0.03));
}
