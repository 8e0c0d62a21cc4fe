// Volumes, affine bodies, sheets, rods and particles brought together, pressed on one another,
// pushed along and pulled off by forces: they stick and part at the stated friction and traction,
// whatever the meshes.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

constexpr double side = 0.1, rod_length = 0.08, radius = 1e-3, peak = 1000, dhat = 1e-4;  // m, m, m, Pa, m

enum class ObjectKind { volume, affine, sheet, rod, particles };
const std::vector<ObjectKind> kinds = {ObjectKind::volume, ObjectKind::affine, ObjectKind::sheet, ObjectKind::rod, ObjectKind::particles};

std::string name_of(ObjectKind kind) {
  return std::vector<std::string>{"volume", "affine", "sheet", "rod", "particles"}[static_cast<size_t>(kind)];
}

bool thick(ObjectKind kind) { return kind == ObjectKind::volume || kind == ObjectKind::affine; }

// A shape centred at y = 0. Rods come in pairs along x, so that an object can stand on them;
// particles that meet rods in two rows.
std::string shape(ObjectKind kind, int cells, bool in_rows) {
  switch (kind) {
    case ObjectKind::volume:
    case ObjectKind::affine: return fmt::format("{{type: box, size: [{0}, 0.01, {0}], cells: [{1}, 1, {1}]}}", side, cells);
    case ObjectKind::sheet: return fmt::format("{{type: grid, size: [{0}, {0}], cells: [{1}, {1}]}}", side, cells);
    case ObjectKind::rod: {
      const std::string rod = fmt::format("{{type: segment, length: {}, edges: {}}}", rod_length, 2 * cells);
      return fmt::format("{{type: parts, parts: [{{shape: {0}, place: {{translate: [0, 0, -0.03]}}}}, {{shape: {0}, place: {{translate: [0, 0, 0.03]}}}}]}}", rod);
    }
    case ObjectKind::particles: break;
  }
  return fmt::format("{{type: points, size: [0.06, 0, 0.06], counts: [4, 1, {}]}}", in_rows ? 2 : 4);
}

// All objects are stiff: a plate that bends would peel.
std::string material(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::volume: return "energies: [{type: neo_hookean, young: 1e9, poisson: 0.3, density: 100}]";
    case ObjectKind::affine: return "body: {type: affine, density: 100}";
    case ObjectKind::sheet:
      return "shell: {thickness: 1 mm}, energies: [{type: stvk_membrane, young: 1e12, poisson: 0.3, density: 1000}, "
             "{type: hinge_bending, young: 1e12, poisson: 0.3}]";
    case ObjectKind::rod: return fmt::format("rod: {{radius: {}}}, energies: [{{type: elastic_rod, young: 1e11, density: 1000}}]", radius);
    case ObjectKind::particles: break;
  }
  return fmt::format("particle: {{radius: {}}}, energies: [{{type: particle, density: 2000}}]", radius);
}

double half_height(ObjectKind kind) { return thick(kind) ? 0.005 : 0; }

struct Stack {
  ObjectKind lower, upper;
  int lower_cells, upper_cells;

  bool rows() const { return lower == ObjectKind::rod || upper == ObjectKind::rod; }
  bool crossed() const { return lower == ObjectKind::rod && upper == ObjectKind::rod; }

  // The lower object is fixed. more: loads on the upper one.
  std::string objects(double gap, const std::string& more) const {
    return fmt::format("objects:\n  - {{name: lower, shape: {}, {}, motion: [fixed]}}\n"
                       "  - {{name: upper, shape: {}, {}, place: {{axis: [0, 1, 0], angle: {} deg, translate: [0, {}, 0]}}, {}}}\n",
                       shape(lower, lower_cells, rows()), material(lower), shape(upper, upper_cells, rows()), material(upper),
                       crossed() ? 90 : 0, half_height(lower) + half_height(upper) + gap, more);
  }

  // Area that lies opposite [m^2].
  double measure() const {
    const double width = 2 * radius;
    if (crossed()) return 4 * width * width;
    if (lower == ObjectKind::particles || upper == ObjectKind::particles) return (rows() ? 8 : 16) * M_PI * radius * radius;
    return rows() ? 2 * width * rod_length : side * side;
  }
};

// Mass of the upper object [kg].
double mass(const Stack& stack) {
  switch (stack.upper) {
    case ObjectKind::volume:
    case ObjectKind::affine: return 100 * side * side * 0.01;
    case ObjectKind::sheet: return 1000 * side * side * 1e-3;
    case ObjectKind::rod: return 2 * 1000 * M_PI * radius * radius * rod_length;
    case ObjectKind::particles: break;
  }
  return (stack.rows() ? 8 : 16) * 2000 * 4 / 3.0 * M_PI * std::pow(radius, 3);
}

// Presses for 0.25 s, then pulls with 0.95 of the adhesive force until 1 s, and with 1.05 of it from 1.25 s.
std::string pulled(const Stack& stack, const std::string& select = "all") {
  return fmt::format("loads: [{{type: body_force, value: [0, {}, 0], select: {}, "
                     "ramp: [[0, -0.5], [0.25, -0.5], [0.75, 0.95], [1, 0.95], [1.25, 1.05], [9, 1.05]]}}]",
                     peak * stack.measure() / mass(stack), select);
}

// contact: y of the upper vertex at a gap of zero.
void check_pull_off(TestRun& run, int upper_vertex, double contact) {
  const auto gap = [&] { return run.at(upper_vertex).y() - contact; };
  while (run.state().time < 1 - 1e-9) CHECK(run.step().intersections == 0);
  CHECK(gap() > 0);
  CHECK(gap() < 1.5 * dhat);
  while (run.state().time < 2 - 1e-9) run.step();
  CHECK(gap() > 5 * dhat);
}

constexpr const char* pull_times = "time: {step: 50 ms, duration: 9}\n";

void check_pull_off_between(ObjectKind a, ObjectKind b, int m, int n) {
  INFO(name_of(b) << " on " << name_of(a) << ", " << m << " and " << n << " cells");
  const Stack stack{a, b, m, n};
  TestRun run(pull_times + stack.objects(1e-3, pulled(stack)) +
              fmt::format("contact:\n  distance: {}\n  pairs: [{{between: [lower, upper], adhesion: {{type: fang, young: 1e4, critical_strain: "
                          "0.1}}}}]\n", dhat));
  const int upper = run.world->bodies[run.world->body_index("upper")].first_vertex;
  check_pull_off(run, upper, run.rest(upper).y() - 1e-3);
}

}  // namespace

TEST_CASE("forces separate objects that adhere, between all kinds of objects", "[contact][all_pairs]") {
  for (const ObjectKind a : kinds)
    for (const ObjectKind b : kinds) check_pull_off_between(a, b, 3, 4);
}

TEST_CASE("forces separate objects that adhere, between all kinds of objects, with finer cells", "[contact][all_pairs][nightly]") {
  for (const ObjectKind a : kinds)
    for (const ObjectKind b : kinds) check_pull_off_between(a, b, 6, 5);
}

TEST_CASE("forces separate parts of one object that adhere, for each kind of object", "[contact][all_pairs]") {
  for (const ObjectKind kind : {ObjectKind::volume, ObjectKind::sheet, ObjectKind::rod, ObjectKind::particles})
    for (const auto& [m, n] : {std::pair{3, 4}, std::pair{6, 5}}) {
      INFO(name_of(kind) << ", " << m << " and " << n << " cells");
      const Stack stack{kind, kind, m, n};
      const double distance = 2 * half_height(kind) + 1e-3, middle = half_height(kind) + 5e-4;
      TestRun run(std::string(pull_times) + "objects:\n" +
                  fmt::format("  - {{name: two, shape: {{type: parts, parts: [{{shape: {}}}, {{shape: {}, place: {{axis: [0, 1, 0], angle: {} deg, "
                              "translate: [0, {}, 0]}}}}]}}, {}, motion: [{{type: fixed, select: {{type: box, min: [-1, -1, -1], max: [1, {}, "
                              "1]}}}}], {}}}\n", shape(kind, m, stack.rows()), shape(kind, n, stack.rows()), stack.crossed() ? 90 : 0, distance,
                              material(kind), middle, pulled(stack, fmt::format("{{type: box, min: [-1, {}, -1], max: [1, 1, 1]}}", middle))) +
                  fmt::format("contact:\n  distance: {}\n  pairs: [{{between: [two, two], adhesion: {{type: fang, young: 1e4, critical_strain: 0.1}}}}]\n", dhat));
      int upper = 0;
      while (run.rest(upper).y() < middle) ++upper;
      check_pull_off(run, upper, run.rest(upper).y() - 1e-3);
    }
}

TEST_CASE("friction holds or slows objects that are pushed, between all kinds of objects", "[contact][all_pairs]") {
  const double gravity = 10, mu = 0.3;
  for (const ObjectKind a : kinds)
    for (const ObjectKind b : kinds) {
      if (a == ObjectKind::particles && b == ObjectKind::particles) continue;  // one point on another: nothing to slide on
      for (const double push : {2.0, 4.0}) {
        INFO(name_of(b) << " on " << name_of(a) << ", pushed by " << push << " m/s^2");
        const Stack stack{a, b, 3, 4};
        TestRun run(fmt::format("time: {{step: 5 ms, duration: 1}}\ngravity: [0, {}, 0]\n", -gravity) +
                    stack.objects(0.5 * dhat, fmt::format("loads: [{{type: body_force, value: [{}, 0, 0]}}]", push)) +
                    fmt::format("contact: {{distance: {}, friction: {{mu: {}, eps_v: 1 mm/s}}}}\n", dhat, mu));
        const int upper = run.world->body_index("upper");
        std::vector<double> x;
        for (int i = 0; i < 12; ++i) {
          CHECK(run.step().intersections == 0);
          x.push_back(run.world->centre_of_mass(upper, run.state().x).x());
        }
        const double before = (x[6] - x[5]) / 5e-3, after = (x[11] - x[10]) / 5e-3;
        if (push < mu * gravity) CHECK(std::abs(after) < 1e-3);
        else CHECK((after - before) / 25e-3 == Approx(push - mu * gravity).epsilon(0.05));
      }
    }
}
