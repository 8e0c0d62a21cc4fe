// Shells and plates of the literature, converging: the Scordelis-Lo roof, the pinched cylinder, buckling, a supported plate.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>

#include "tests/support/program.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

const std::vector<std::string> both = {"uniform", "alternating"};

// The grid of `cells` that `place` maps from [0, 1]^2, `around` closed in its first direction.
std::string mapped_grid(const std::array<int, 2>& cells, bool around, bool alternating, const std::function<Vec3(double, double)>& place) {
  std::string obj;
  for (int j = 0; j <= cells[1]; ++j)
    for (int i = 0; i < cells[0] + !around; ++i) {
      const Vec3 x = place(double(i) / cells[0], double(j) / cells[1]);
      obj += fmt::format("v {} {} {}\n", x.x(), x.y(), x.z());
    }
  const int row = cells[0] + !around;
  for (int j = 0; j < cells[1]; ++j)
    for (int i = 0; i < cells[0]; ++i) {
      const int a = 1 + i + row * j, b = 1 + (i + 1) % row + row * j, c = b + row, d = a + row;
      if (alternating && (i + j) % 2 == 0) obj += fmt::format("f {0} {1} {3}\nf {1} {2} {3}\n", a, b, c, d);
      else obj += fmt::format("f {0} {1} {2}\nf {0} {2} {3}\n", a, b, c, d);
    }
  return obj;
}

// Deflection in the middle of a free side, over that of shell theory (Scordelis and Lo 1969; MacNeal and Harder 1985).
double roof(int cells, bool alternating) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "roof.obj").string();
  write_file(path, mapped_grid({cells, cells}, false, alternating, [](double u, double v) {
    const double angle = (2 * u - 1) * 40 * 3.14159265358979323846 / 180;
    return Vec3(25 * std::sin(angle), 25 * std::cos(angle), 50 * v - 25);
  }));
  const int middle = cells / 2;
  TestRun run(fmt::format(
      "time: {{step: 1, duration: 1, integrator: quasi_static}}\nobjects:\n"
      "  - name: roof\n    shape: {{type: file, path: {0}}}\n    shell: {{thickness: 0.25}}\n"
      "    energies: [{{type: stvk_membrane, young: 4.32e8, poisson: 0}}, {{type: hinge_bending, young: 4.32e8, poisson: 0, rest: mesh}}]\n"
      "    motion:\n      - {{type: fixed, across: [0, 0, 1], select: {{type: face, direction: [0, 0, 1]}}}}\n"
      "      - {{type: fixed, across: [0, 0, 1], select: {{type: face, direction: [0, 0, -1]}}}}\n"
      "      - {{type: fixed, along: [0, 0, 1], select: {{type: indices, vertices: [{1}]}}}}\n"
      "    loads: [{{type: traction, value: [0, -0.9, 0]}}]\nsolver: {{type: projected_newton, force_tolerance: 1e-7}}\n",
      path, middle * (cells + 1) + middle));
  run.step();
  const int side = middle * (cells + 1);
  return (run.rest(side) - run.at(side)).y() / 0.003024;
}

// Under one of the loads, over 1.8248e-5 of each unit of force (Lindberg, Olson and Cowper 1969).
double pinched_cylinder(int cells, bool alternating) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "cylinder.obj").string();
  write_file(path, mapped_grid({cells, cells / 2}, true, alternating, [](double u, double v) {
    const double angle = 2 * 3.14159265358979323846 * u;
    return Vec3(300 * std::cos(angle), 300 * std::sin(angle), 600 * v - 300);
  }));
  const int middle = cells / 4 * cells;
  TestRun run(fmt::format(
      "time: {{step: 1, duration: 1, integrator: quasi_static}}\nobjects:\n"
      "  - name: cylinder\n    shape: {{type: file, path: {0}}}\n    shell: {{thickness: 3}}\n"
      "    energies: [{{type: stvk_membrane, young: 3e6, poisson: 0.3}}, {{type: hinge_bending, young: 3e6, poisson: 0.3, rest: mesh}}]\n"
      "    motion:\n      - {{type: fixed, across: [0, 0, 1], select: {{type: face, direction: [0, 0, 1]}}}}\n"
      "      - {{type: fixed, across: [0, 0, 1], select: {{type: face, direction: [0, 0, -1]}}}}\n"
      "      - {{type: fixed, along: [0, 0, 1], select: {{type: indices, vertices: [{1}, {2}]}}}}\n"
      "    loads:\n      - {{type: force, value: [-100, 0, 0], select: {{type: indices, vertices: [{1}]}}}}\n"
      "      - {{type: force, value: [100, 0, 0], select: {{type: indices, vertices: [{3}]}}}}\n"
      "solver: {{type: projected_newton, force_tolerance: 1e-7}}\n",
      path, middle, middle + cells / 4, middle + cells / 2));
  run.step();
  const double closer = (run.rest(middle) - run.at(middle)).x() - (run.rest(middle + cells / 2) - run.at(middle + cells / 2)).x();
  return closer / 2 / 1.8248e-3;
}

struct Plate {
  double first, last, force;  // deflections without and with most of the force that is
};

constexpr double young = 1e8, poisson = 0.3, thickness = 1e-3, side = 0.1;
const double stiffness = young * std::pow(thickness, 3) / (12 * (1 - poisson * poisson));
const double pressure = 1e-4 * stiffness / std::pow(side, 3);
const double critical = 4 * std::pow(3.14159265358979323846, 2) * stiffness / side;  // N

// A square plate, supported at its sides, under little pressure, that is pushed together from two sides.
Plate supported_plate(int n, const std::string& grid) {
  std::vector<int> border;
  for (int v = 0; v < (n + 1) * (n + 1); ++v)
    if (const int i = v % (n + 1), k = v / (n + 1); i == 0 || i == n || k == 0 || k == n) border.push_back(v);
  const int middle = (n / 2) * (n + 2);
  const double speed = 0.7 * critical / (young * thickness * side) * side / 2;
  TestRun run(fmt::format(
      "time: {{step: 1, duration: 2, integrator: quasi_static}}\nobjects:\n"
      "  - name: plate\n    shape: {{type: grid, size: [{0}, {0}], cells: [{1}, {1}], diagonals: {2}}}\n    shell: {{thickness: {3}}}\n"
      "    energies: [{{type: stvk_membrane, young: {4}, poisson: {5}}}, {{type: hinge_bending, young: {4}, poisson: {5}}}]\n"
      "    motion:\n      - {{type: fixed, along: [0, 1, 0], select: {{type: indices, vertices: [{6}]}}}}\n"
      "      - {{type: fixed, along: [0, 0, 1], select: {{type: indices, vertices: [{7}]}}}}\n"
      "      - {{type: translate, along: [1, 0, 0], velocity: [-{8}, 0, 0], from: 1, select: {{type: face, direction: [1, 0, 0]}}}}\n"
      "      - {{type: translate, along: [1, 0, 0], velocity: [{8}, 0, 0], from: 1, select: {{type: face, direction: [-1, 0, 0]}}}}\n"
      "      - {{type: fixed, along: [1, 0, 0], until: 1, select: {{type: indices, vertices: [{7}]}}}}\n"
      "    loads: [{{type: traction, value: [0, -{9}, 0]}}]\n"
      "probes: [{{name: P, type: reaction, object: plate, direction: [-1, 0, 0], select: {{type: face, direction: [1, 0, 0]}}}}]\n"
      "solver: {{type: projected_newton, force_tolerance: 1e-8}}\n",
      side, n, grid, thickness, young, poisson, fmt::join(border, ", "), middle, speed, pressure));
  Plate out{};
  run.step();
  out.first = -run.at(middle).y();
  run.step();
  out.last = -run.at(middle).y();
  out.force = run.sample(0)[0];
  return out;
}

}  // namespace

TEST_CASE("the deflection of the Scordelis-Lo roof converges to the reference", "[shells]") {
  for (const bool alternating : {false, true}) {
    INFO((alternating ? "alternating" : "uniform"));
    const double coarse = roof(16, alternating), fine = roof(32, alternating), finest = roof(48, alternating);
    CHECK(coarse == Approx(0.865).margin(0.02));
    CHECK(fine == Approx(0.955).margin(0.01));
    CHECK(finest == Approx(0.975).margin(0.01));
  }
}

TEST_CASE("the deflection of a pinched cylinder converges to the reference", "[shells]") {
  for (const bool alternating : {false, true}) {
    INFO((alternating ? "alternating" : "uniform"));
    const double coarse = pinched_cylinder(64, alternating), fine = pinched_cylinder(128, alternating);
    CHECK(std::abs(coarse - 1) < 0.13);
    CHECK(std::abs(fine - 1) < 0.06);
  }
}

TEST_CASE("a supported plate sinks by 0.00406 p L^4 / D, and buckles at 4 pi^2 D / L", "[shells]") {
  for (const std::string& grid : both) {
    for (const auto& [cells, within] : {std::pair(8, 0.03), {16, 0.015}, {24, 0.01}}) {
      INFO(grid << " " << cells);
      const Plate plate = supported_plate(cells, grid);
      CHECK(plate.first == Approx(0.00406235 * pressure * std::pow(side, 4) / stiffness).epsilon(within));
      REQUIRE(plate.force > 0.6 * critical);
      // Deflections grow by 1 / (1 - P / P_critical) (Southwell).
      CHECK(plate.force / (1 - plate.first / plate.last) == Approx(critical).epsilon(within));
    }
  }
}
