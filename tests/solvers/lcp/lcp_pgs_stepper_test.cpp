// Constraints and projected Gauss-Seidel: closed forms, and the state of a run.
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cmath>

#include "framework/world/world.hpp"
#include "geometry/errors.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

constexpr double g = 9.81;

struct Slope {
  double tangent, mu;
  std::string block = "energies: [{type: neo_hookean, young: 1 MPa, density: 1000}]";
  double length = 1;  // unit of length [m]; the unit of time is its square root [s]
  std::string stepper = "sweeps: 1000";
};

// A block on a plane that lies flat; gravity is turned instead.
std::string slope(const Slope& s) {
  const double angle = std::atan(s.tangent), l = s.length, young = 1e6 * l;
  std::string block = s.block;
  if (const auto at = block.find("1 MPa"); at != std::string::npos) block.replace(at, 5, fmt::format("{}", young));
  return fmt::format(
      "time: {{step: {}, duration: {}, stepper: {{type: lcp_pgs, tolerance: {}, {}}}}}\n"
      "gravity: [{}, {}, 0]\n"
      "objects:\n"
      "  - {{name: plane, shape: {{type: box, size: [{}, {}, {}], cells: [3, 1, 2]}}, place: {{translate: [0, {}, 0]}}, motion: [fixed]}}\n"
      "  - {{name: block, shape: {{type: box, size: [{}, {}, {}], cells: [3, 1, 2]}}, place: {{translate: [0, {}, {}]}}, {}}}\n"
      "contact: {{distance: {}, friction: {{mu: {}}}}}\n",
      0.01 * std::sqrt(l), 0.5 * std::sqrt(l), 1e-7 * std::sqrt(l), s.stepper, g * std::sin(angle), -g * std::cos(angle), 3 * l, 0.1 * l, l, -0.05 * l, 0.2 * l,
      0.04 * l, 0.1 * l, 0.0205 * l, 0.013 * l, block, 0.001 * l, s.mu);
}

// Height of the block, relative to the unit of length.
double way_of(TestRun& run, double length = 1) {
  const int block = run.world->index_of("block");
  const Vec3 way = run.world->centre_of_mass(block, run.state().x) - run.world->centre_of_mass(block, run.world->start.x);
  CHECK(std::abs(way.y()) < 1e-5 * length);
  CHECK(std::abs(way.z()) < 1e-5 * length);
  return way.x() / length;
}

void run_to_end(TestRun& run) {
  while (!run.stepper.finished()) {
    const StepReport report = run.step();
    REQUIRE(report.intersections == 0);
    REQUIRE(report.rejections.cutbacks() == 0);
  }
}

// Displacement of implicit Euler in 50 steps of 10 ms with a constant acceleration.
double slid(const Slope& s) {
  const double angle = std::atan(s.tangent), a = g * (std::sin(angle) - s.mu * std::cos(angle));
  return a * 1e-4 * 50 * 51 / 2;
}

// A block that hangs from a ceiling by RCC adhesion whose peak is 100 Pa, pulled by a fraction of it.
std::string hang(const std::string& law, double load, const std::string& block = "energies: [{type: neo_hookean, young: 1 MPa, density: DENSITY}]") {
  std::string text = fmt::format(
      "time: {{step: 0.01, duration: 0.4, stepper: {{type: lcp_pgs, sweeps: 1000, tolerance: 1e-8}}}}\n"
      "gravity: [0, -10, 0]\n"
      "objects:\n"
      "  - {{name: ceiling, shape: {{type: box, size: [0.4, 0.1, 0.4], cells: [3, 1, 3]}}, place: {{translate: [0.02, 0.05, 0.01]}}, motion: [fixed]}}\n"
      "  - {{name: block, shape: {{type: box, size: [0.1, 0.02, 0.1], cells: [3, 1, 3]}}, place: {{translate: [0, -0.0105, 0]}}, {}}}\n"
      "contact: {{distance: 1 mm, pairs: [{{between: [ceiling, block], adhesion: {{type: {}, normal_stiffness: 1e5, tangential_stiffness: 1e5, "
      "work_of_adhesion: 0.1, viscosity: 0.01}}}}]}}\n",
      block, law);
  const double density = load * 100 / (0.02 * 10);
  while (text.find("DENSITY") != std::string::npos) text.replace(text.find("DENSITY"), 7, fmt::format("{}", density));
  return text;
}

double height_of(TestRun& run) {
  const int block = run.world->index_of("block");
  return run.world->centre_of_mass(block, run.state().x).y() - run.world->centre_of_mass(block, run.world->start.x).y();
}

}  // namespace

TEST_CASE("a block rests on a slope within Coulomb's cone, and slides with Coulomb's speed beyond it", "[lcp]") {
  for (const std::string& block : {std::string("energies: [{type: neo_hookean, young: 1 MPa, density: 1000}]"),
                                   std::string("body: {type: affine, density: 1000}")}) {
    INFO(block);
    const Slope steep{0.55, 0.5, block}, flat{0.49, 0.5, block};
    TestRun sliding(slope(steep)), resting(slope(flat));
    run_to_end(sliding);
    CHECK(way_of(sliding) == Approx(slid(steep)).epsilon(0.005));
    run_to_end(resting);
    CHECK(std::abs(way_of(resting)) < 2e-5);  // that the block is sheared by
    const double speed = (resting.state().v).lpNorm<Eigen::Infinity>();
    CHECK(speed < 1e-4);
  }
}

TEST_CASE("constraints do not depend on units", "[lcp]") {
  const Slope here{0.55, 0.5};
  TestRun run(slope(here));
  run_to_end(run);
  for (const double length : {1e-3, 1e3}) {
    Slope there = here;
    there.length = length;
    TestRun scaled(slope(there));
    run_to_end(scaled);
    CHECK(way_of(scaled, length) == Approx(way_of(run)).epsilon(1e-3));
  }
}

TEST_CASE("blocks of dense rows give the solution of one dense operator", "[lcp]") {
  Slope s{0.49, 0.5};
  TestRun dense(slope(s));
  s.stepper = "sweeps: 1000, dense_rows: 9";
  TestRun blocks(slope(s));
  for (int i = 0; i < 10; ++i) {
    const StepReport a = dense.step(), b = blocks.step();
    CHECK(a.converged);
    CHECK(b.converged);
  }
  CHECK((dense.state().x - blocks.state().x).lpNorm<Eigen::Infinity>() < 1e-7);
}

TEST_CASE("a block hangs by adhesion rows with their stiffness, and falls beyond their peak", "[lcp]") {
  for (const char* law : {"rcc", "rcc_explicit"}) {
    INFO(law);
    TestRun half(hang(law, 0.5));
    run_to_end(half);
    CHECK(height_of(half) == Approx(-0.5e-3).epsilon(0.02));
    TestRun more(hang(law, 1.2));
    run_to_end(more);
    CHECK(height_of(more) < -0.1);
    TestRun affine(hang(law, 0.5, "body: {type: affine, density: DENSITY}"));
    run_to_end(affine);
    CHECK(height_of(affine) == Approx(-0.5e-3).epsilon(0.02));
  }
}

TEST_CASE("bodies with prescribed motion push others with their velocity", "[lcp]") {
  TestRun run(
      "time: {step: 0.01, duration: 0.3, stepper: {type: lcp_pgs, sweeps: 500}}\n"
      "objects:\n"
      "  - {name: plate, shape: {type: box, size: [0.02, 0.2, 0.2], cells: [1, 2, 2]}, motion: [{type: translate, velocity: [0.5, 0, 0]}]}\n"
      "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [0.0705, 0.01, 0.01]},\n"
      "     energies: [{type: neo_hookean, young: 1e5}], damping: {stiffness: 0.01}}\n"
      "contact: {distance: 1 mm}\n");
  run_to_end(run);
  const int block = run.world->index_of("block"), plate = run.world->index_of("plate");
  CHECK(run.world->centre_of_mass(block, run.state().v).x() == Approx(0.5).epsilon(0.1));  // it vibrates
  CHECK(run.state().v(3 * run.world->bodies[plate].first_vertex) == Approx(0.5));
}

TEST_CASE("a sheet comes to rest on a box, each side of it on its own", "[lcp]") {
  TestRun run(
      "time: {step: 0.005, duration: 0.4, stepper: {type: lcp_pgs, sweeps: 300}}\n"
      "gravity: [0, -10, 0]\n"
      "objects:\n"
      "  - {name: box, shape: {type: box, size: [0.3, 0.1, 0.3], cells: [3, 1, 3]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}\n"
      "  - {name: sheet, shape: {type: grid, size: [0.2, 0.2], cells: [6, 6]}, place: {translate: [0.01, 0.02, 0]}, shell: {thickness: 1 mm},\n"
      "     energies: [{type: neo_hookean_membrane, young: 1e5, density: 500}, {type: hinge_bending, stiffness: 1e-4}], damping: {mass: 5}}\n"
      "contact: {distance: 2 mm, friction: {mu: 0.3}}\n");
  run_to_end(run);
  const Body& sheet = run.world->bodies[1];
  for (int v = sheet.first_vertex; v < sheet.first_vertex + sheet.vertex_count; ++v) CHECK(run.at(v).y() == Approx(1e-3).margin(2e-5));
  CHECK(run.state().v.lpNorm<Eigen::Infinity>() < 1e-2);
}

TEST_CASE("steps with constraints have the same bits for any number of threads, and in a resumed run", "[lcp]") {
  const std::string scene = slope({0.55, 0.5, "energies: [{type: neo_hookean, young: 1 MPa, density: 1000}]", 1, "sweeps: 30"});
  TestRun whole(scene);
  State half;
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    for (int i = 0; i < 20; ++i) {
      if (i == 10) half = whole.state();
      whole.step();
    }
  }
  CHECK_FALSE(half.history.empty());
  TestRun again(scene);
  again.simulation.start_from(half);
  for (int i = 0; i < 10; ++i) again.simulation.step();
  CHECK((again.simulation.state().x == whole.state().x));
  CHECK((again.simulation.state().history == whole.state().history));
}

TEST_CASE("bodies that pass through each other are recorded with a warning, and the run continues", "[lcp]") {
  // Far too few sweeps for a stack that is pressed together.
  TestRun run(
      "time: {step: 0.02, duration: 0.4, stepper: {type: lcp_pgs, sweeps: 1, tolerance: 1e-9}}\n"
      "gravity: [0, -300, 0]\n"
      "objects:\n"
      "  - {name: floor, shape: {type: box, size: [1, 0.2, 1], cells: [2, 1, 2]}, place: {translate: [0, -0.1, 0]}, motion: [fixed]}\n"
      "  - {name: a, shape: {type: box, size: [0.2, 0.2, 0.2], cells: [3, 3, 3]}, place: {translate: [0.01, 0.101, 0]}, energies: [{type: neo_hookean, young: 1e6}]}\n"
      "  - {name: b, shape: {type: box, size: [0.2, 0.2, 0.2], cells: [3, 3, 3]}, place: {translate: [0.02, 0.302, 0.01]}, energies: [{type: neo_hookean, young: 1e6}]}\n"
      "  - {name: c, shape: {type: box, size: [0.2, 0.2, 0.2], cells: [3, 3, 3]}, place: {translate: [0, 0.503, 0]}, energies: [{type: neo_hookean, young: 1e6}]}\n"
      "contact: {distance: 1 mm}\n");
  int crossed = 0;
  double deepest = 0;
  bool unconverged = false;
  while (!run.stepper.finished()) {
    const StepReport report = run.step();
    CHECK(report.rejections.cutbacks() == 0);
    CHECK(report.metrics.size() == 5);
    for (const StepMetric& metric : report.metrics) {
      if (metric.name == "crossing_pairs") CHECK(metric.value == report.intersections);
      if (metric.name == "penetration") deepest = std::max(deepest, metric.value);
    }
    crossed += report.intersections;
    unconverged = unconverged || !report.converged;
  }
  CHECK(crossed > 0);
  CHECK(deepest > 1e-4);
  CHECK(unconverged);
  CHECK_THAT(first_text(run.warnings, WarningKind::stepper_fault), Catch::Contains("passed through each other"));
}

TEST_CASE("features without constraint rows are refused by name", "[lcp]") {
  const std::string block = "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 0.0605, 0]}, energies: [{type: neo_hookean, young: 1e5}]}\n";
  const auto scene = [&](const std::string& time, const std::string& objects, const std::string& pair) {
    return "time: {step: 0.01, duration: 1, stepper: lcp_pgs" + time + "}\nobjects:\n"
           "  - {name: floor, shape: {type: box, size: [1, 0.02, 1]}, motion: [fixed]}\n" + objects +
           "contact: {distance: 1 mm, pairs: [{between: [floor, block], " + pair + "}]}\n";
  };
  CHECK(error_of<TestRun>(scene("", block, "friction: {mu: 0.5}")).empty());
  CHECK(contains(error_of<TestRun>(scene(", integrator: newmark", block, "friction: {mu: 0.5}")), "time.integrator is newmark"));
  CHECK(contains(error_of<TestRun>(scene("", block, "adhesion: {type: fang, critical_strain: 0.01}")), "rows for RCC adhesion alone, and a pair adheres by 'fang'"));
  CHECK(contains(error_of<TestRun>(scene("", block, "adhesion: {type: bilinear, peak_traction: 1e3, work_of_adhesion: 0.1}")), "adheres by 'bilinear'"));
  std::string lagged = scene("", block, "friction: {mu: 0.5}");
  lagged.insert(lagged.find("pairs:"), "lagging: {iterations: 3}, ");
  CHECK(contains(error_of<TestRun>(lagged), "finds friction and what presses together, without contact.lagging"));
  const std::string dust = "  - {name: dust, shape: {type: points}, place: {translate: [0, 1, 0]}, particle: {radius: 1 mm}, energies: [{type: particle, mass: 1}]}\n";
  CHECK(contains(error_of<TestRun>(scene("", block + dust, "friction: {mu: 0.5}")), "'dust' has particles"));
}

TEST_CASE("contact forces, friction and reactions are the impulses over h", "[lcp]") {
  const double weight = 0.2 * 0.04 * 0.1 * 1000 * g, angle = std::atan(0.49);
  TestRun run(slope({0.49, 0.5}) +
              "probes:\n"
              "  - {name: normal, type: contact_force, on: block, from: plane}\n"
              "  - {name: friction, type: friction_force, on: block, from: plane}\n"
              "  - {name: reaction, type: reaction, object: plane}\n"
              "  - {name: opposite, type: contact_force, on: plane, from: block}\n");
  run_to_end(run);
  const auto vector = [&](size_t probe) {
    const std::vector<double> v = run.sample(probe);
    return Vec3(v[0], v[1], v[2]);
  };
  const Vec3 normal = vector(0), friction = vector(1), reaction = vector(2);
  CHECK(normal.y() == Approx(weight * std::cos(angle)).epsilon(1e-3));
  CHECK(friction.x() == Approx(-weight * std::sin(angle)).epsilon(1e-3));
  CHECK((reaction - normal - friction).norm() < 1e-9 * weight);
  CHECK((vector(3) + normal).norm() < 1e-9 * weight);
  // No energy is gained, and sliding dissipates the loss.
  TestRun sliding(slope({0.55, 0.5}));
  double dissipated = 0, numerics = 0;
  while (!sliding.stepper.finished()) {
    const StepReport report = sliding.step();
    dissipated += report.flows.of("dissipated_friction");
    numerics += report.flows.numerics;
  }
  const double steep = std::atan(0.55);
  CHECK(dissipated == Approx(0.5 * weight * std::cos(steep) * slid({0.55, 0.5})).epsilon(0.01));
  CHECK(numerics > 0);
}

TEST_CASE("a probe of an unknown step metric is refused with its source location", "[lcp]") {
  const TemporaryFolder folder;
  const auto error_of_probe = [&](const std::string& time, const std::string& figure) {
    write_file(folder.path() / "scene.yaml",
               "name: probed\ntime: {step: 0.01, duration: 0.02" + time + "}\nobjects:\n"
               "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1]}, energies: [{type: neo_hookean, young: 1e5}]}\n"
               "probes:\n  - {name: p, type: step, figure: " + figure + "}\n");
    const ProgramResult result = run_tack(folder.path(), {"check", "scene.yaml"});
    return std::pair(result.exit_code, result.err);
  };
  CHECK(error_of_probe(", stepper: lcp_pgs", "crossing_pairs").first == 0);
  const auto [misspelt, text] = error_of_probe(", stepper: lcp_pgs", "crossing_pair");
  CHECK(misspelt == 2);
  CHECK(contains(text, "scene.yaml:6:5: probe 'p': the stepper reports no metric named 'crossing_pair'; did you mean 'crossing_pairs'?"));
  CHECK(contains(error_of_probe("", "sweeps").second, "the scene's stepper reports no step metrics; remove the probe"));
}

TEST_CASE("bodies that meet on the path between two distant positions stop there", "[lcp]") {
  // Ten times its own size in a step, at a sheet a millimetre thick.
  TestRun run(
      "time: {step: 0.01, duration: 0.05, stepper: {type: lcp_pgs, sweeps: 500}}\n"
      "objects:\n"
      "  - {name: sheet, shape: {type: grid, size: [1, 1], cells: [6, 6]}, place: {axis: [0, 0, 1], angle: 90 deg}, shell: {thickness: 1 mm}, motion: [fixed]}\n"
      "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [-0.53, 0.03, 0.01]}, velocity: [100, 0, 0],\n"
      "     body: {type: affine, density: 200}}\n"
      "contact: {distance: 1 mm}\n");
  run_to_end(run);
  const int block = run.world->index_of("block");
  CHECK(run.world->centre_of_mass(block, run.state().x).x() == Approx(-0.05).margin(2e-3));
  CHECK(std::abs(run.world->centre_of_mass(block, run.state().v).x()) < 1);
}
