// Protocols: every kind of end, of action and of follower, against closed forms; errors; bits of
// resumed runs and of any number of threads.
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cmath>

#include "framework/output/csv.hpp"
#include "framework/run/changed_scene.hpp"
#include "geometry/errors.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// A block of 1 cm^3 of a linear stiffness of about 1 N/mm along y, E = 100 kPa, whose upper face a
// drive moves; force: in compression.
std::string block(const std::string& stages, const std::string& time = "integrator: quasi_static", const std::string& more = "") {
  return fmt::format(R"(time: {{step: 10 ms, duration: 2 s, {1}}}
objects:
  - name: block
    shape: {{type: box, size: [10 mm, 10 mm, 10 mm], cells: [2, 2, 2]}}
    energies: [{{type: neo_hookean, young: 100 kPa, poisson: 0, density: 1000}}]
    motion:
      - {{type: fixed, select: {{type: face, direction: [0, -1, 0]}}}}
      - {{type: driven, drive: head, direction: [0, 3, 0], select: {{type: face, direction: [0, 1, 0]}}}}
probes:
  - {{name: force, type: reaction, object: block, select: {{type: face, direction: [0, 1, 0]}}, direction: [0, -1, 0]}}
  - name: height
    type: separation
    from: {{object: block, select: {{type: face, direction: [0, -1, 0]}}}}
    to: {{object: block, select: {{type: face, direction: [0, 1, 0]}}}}
    direction: [0, 1, 0]
  - {{name: stage, type: stage}}
solver: {{type: projected_newton, tolerance: 1e-8}}
output: {{frames: false}}
protocols:
  - name: press
    stages:
{0}{2})", stages, time, more);
}

std::string stage(const std::string& text) { return "      - {" + text + "}\n"; }

const std::string down = "drive: {head: {velocity: -1 mm/s}}";

// Steps to the end of the protocol or of the run.
void run_through(TestRun& run) {
  while (!run.simulation.finished()) run.step();
}

std::vector<StageVisit> visits(TestRun& run) { return run.simulation.protocols()->visits(run.state().time); }

double value(TestRun& run, size_t probe) { return run.sample(probe)[0]; }

}  // namespace

TEST_CASE("each kind of end is found where it is", "[protocol]") {
  const auto end = GENERATE(as<std::pair<std::string, double>>{},  // an end, and the height there [m]
                            std::pair{"time: 0.123 s", 0.01 - 0.123e-3},
                            std::pair{"probe: height, below: 9.777 mm, within: 0.01 um", 9.777e-3},
                            std::pair{"when: height < 9.6543e-3", 9.6543e-3},
                            std::pair{"when: t > 0.2005 && height < 1", 0.01 - 0.2005e-3},
                            std::pair{"time: 1.9 s, or: [{probe: height, below: 9.5 mm, within: 1 nm}, {probe: force, above: 10 N}]", 9.5e-3});
  const std::string integrator = GENERATE("quasi_static", "implicit_euler", "tr_bdf2");
  INFO(end.first << " " << integrator);
  TestRun run(block(stage("name: load, " + down + ", until: {" + end.first + "}"), "integrator: " + integrator));
  run_through(run);
  CHECK(value(run, 1) == Approx(end.second).margin(1.1e-8));  // of the tolerance of time
  REQUIRE(visits(run).size() == 1);
  CHECK_FALSE(visits(run)[0].ended_by.empty());
  CHECK(run.simulation.protocols()->fault(run.state().time, true).empty());
}

TEST_CASE("a force ends a stage within its tolerance, with constant and adaptive steps", "[protocol]") {
  const std::string time = GENERATE("integrator: quasi_static", "integrator: quasi_static, adaptive: {error: 1 um}", "integrator: implicit_euler");
  TestRun run(block(stage("name: load, " + down + ", until: {probe: force, above: 0.05 N}") + stage("name: hold, until: {time: 0.1 s}"), time));
  while (visits(run).size() < 2) run.step();
  CHECK(value(run, 0) == Approx(0.05).epsilon(1e-3));
  CHECK(value(run, 2) == 1);  // the step belongs to the stage that it ends
  const double begin = run.state().time, height = value(run, 1);
  run_through(run);
  CHECK(run.state().time == Approx(begin + 0.1).epsilon(1e-9));
  CHECK(value(run, 1) == Approx(height).epsilon(1e-12));
  CHECK(value(run, 2) == 2);
  CHECK(run.state().step_size.h_next > 0);
}

TEST_CASE("a rate and a drop end stages", "[protocol]") {
  TestRun rate(block(stage("name: slow, drive: {head: {formula: -1e-3 * (1 - exp(-10 * t))}}, until: {probe: height, rate_below: 1 mm/s}")));
  run_through(rate);
  CHECK(rate.state().time == Approx(std::log(10) / 10).margin(0.01));  // 1e-2 exp(-10 t) = 1e-3
  // sin: the force falls to half of its largest value, 0.5 mm, at 150 degrees
  TestRun drop(block(stage("name: bump, drive: {head: {formula: -1e-5 * sin(2 * pi * t)}}, until: {probe: force, drop: 50 %}")));
  run_through(drop);
  CHECK(drop.state().time == Approx(150.0 / 360).epsilon(0.005));
}

TEST_CASE("a stage of 0 s is passed over", "[protocol]") {
  const std::string press = stage("name: load, " + down + ", until: {time: 0.1 s}"), dwell = stage("name: dwell, until: {time: 0 s}"),
                    back = stage("name: back, drive: {head: {velocity: 1 mm/s}}, until: {time: 0.1 s}");
  TestRun run(block(dwell + press + stage("name: rest, until: {time: 0 s}") + back)), without(block(press + back));
  run_through(run);
  run_through(without);
  CHECK(run.state().x == without.state().x);
  const std::vector<StageVisit> all = visits(run);
  REQUIRE(all.size() == 4);
  CHECK(all[0].end == 0);
  CHECK(all[2].stage == "rest");
  CHECK(all[2].begin == all[2].end);
  CHECK(all[2].ended_by == "0 s");
  CHECK(all[3].begin == Approx(0.1).epsilon(1e-9));
}

TEST_CASE("each kind of action does what it says", "[protocol]") {
  TestRun run(block(stage("name: a, drive: {head: {position: -0.3 mm, speed: 2 mm/s}}, until: {time: 0.3 s}") +
                    stage("name: b, drive: {head: {formula: 1e-4 * sin(pi * t)}}, until: {time: 0.5 s}") + stage("name: c, until: {time: 0.1 s}") +
                    stage("name: d, drive: {head: {control: force, target: 0.02 N, speed: -20 mm/s}}, until: {time: 0.1 s}") +
                    stage("name: e, drive: {head: {control: force, target: 0 N, tolerance: 0.1 mN, speed: -0.1 mm/s}}, until: {time: 0.05 s}")));
  const auto to = [&](double t) {
    while (run.state().time < t - 1e-9) run.step();
  };
  to(0.1);
  CHECK(value(run, 1) == Approx(9.8e-3));
  to(0.3);
  CHECK(value(run, 1) == Approx(9.7e-3).epsilon(1e-9));  // held once it is there
  to(0.8);
  CHECK(value(run, 1) == Approx(9.8e-3).epsilon(1e-9));
  to(0.9);
  CHECK(value(run, 1) == Approx(9.8e-3).epsilon(1e-9));
  to(0.92);
  CHECK(value(run, 0) == Approx(0.02).epsilon(1e-3));
  to(1);
  const double height = value(run, 1);
  CHECK(value(run, 0) == Approx(0.02).epsilon(1e-3));
  to(1.05);  // no faster than its speed
  CHECK(value(run, 1) == Approx(height + 5e-6).epsilon(1e-6));
}

TEST_CASE("stages repeat, and go where `next` says", "[protocol]") {
  TestRun run(block(stage("name: down, drive: {head: {position: -0.1 mm, speed: 10 mm/s}}, until: {time: 20 ms}") +
                    stage("name: up, drive: {head: {position: 0 mm, speed: 10 mm/s}}, until: {time: 20 ms}, next: down, repeat: 2") +
                    stage("name: rest, until: {time: 10 ms}, next: end") + stage("name: never, until: {time: 1 s}")));
  run_through(run);
  std::string names;
  for (const StageVisit& v : visits(run)) names += v.stage + " ";
  CHECK(names == "down up down up down up rest ");
  CHECK(run.state().time == Approx(0.13));
}

TEST_CASE("a drive turns vertices about an axis, at once with another one", "[protocol]") {
  TestRun run(R"(time: {step: 10 ms, duration: 0.2 s, integrator: quasi_static}
objects:
  - name: sheet
    shape: {type: grid, size: [2 cm, 1 cm], cells: [4, 2]}
    shell: {thickness: 1 mm}
    energies: [{type: stvk_membrane, young: 1 MPa, density: 1000}, {type: hinge_bending, young: 1 MPa}]
    motion:
      - {type: driven, drive: left, direction: [-1, 0, 0], select: {type: face, direction: [-1, 0, 0]}}
      - {type: driven, drive: right, axis: [1, 0, 0], select: {type: face, direction: [1, 0, 0]}}
protocols:
  - {name: pull, stages: [{name: a, drive: {left: {velocity: 5 mm/s}}, until: {time: 0.1 s}}]}
  - {name: turn, stages: [{name: a, drive: {right: {velocity: 90 deg/s}}, until: {time: 0.2 s}}]}
)");
  run_through(run);
  CHECK(run.state().time == Approx(0.2));
  for (int v = 0; v < 15; ++v) {
    const Vec3 rest = run.rest(v), now = run.at(v);
    if (rest.x() < -0.0099) CHECK((now - rest - Vec3(-0.5e-3, 0, 0)).norm() < 1e-12);
    const double angle = 18 * std::acos(-1) / 180;
    if (rest.x() > 0.0099) CHECK((now - Vec3(rest.x(), rest.y() * std::cos(angle) - rest.z() * std::sin(angle), rest.y() * std::sin(angle) + rest.z() * std::cos(angle))).norm() < 1e-12);
  }
}

TEST_CASE("a load follows a drive", "[protocol]") {
  TestRun run(R"(time: {step: 10 ms, duration: 1 s, integrator: quasi_static}
objects:
  - name: bar
    shape: {type: box, size: [10 mm, 10 mm, 10 mm]}
    energies: [{type: neo_hookean, young: 100 kPa, poisson: 0, density: 1000}]
    motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}]
    loads: [{type: traction, value: [0, 100 Pa, 0], drive: weight, select: {type: face, direction: [0, 1, 0]}}]
probes:
  - name: strain
    type: separation
    from: {object: bar, select: {type: face, direction: [0, -1, 0]}}
    to: {object: bar, select: {type: face, direction: [0, 1, 0]}}
    relative: true
solver: {type: projected_newton, tolerance: 1e-8}
protocols:
  - name: hang
    stages:
      - {name: none, until: {time: 30 ms}}
      - {name: half, drive: {weight: {factor: 0.5}}, until: {time: 30 ms}}
      - {name: ramp, drive: {weight: {factor: 1, within: 0.1 s}}, until: {time: 0.2 s}}
      - {name: off, drive: {weight: {factor: 0}}, until: {time: 10 ms}}
)");
  const auto strain_at = [&](double t) {
    while (run.state().time < t - 1e-9) run.step();
    return value(run, 0);
  };
  CHECK(strain_at(0.03) == Approx(0).margin(1e-9));
  CHECK(strain_at(0.06) == Approx(5e-4).epsilon(2e-3));
  CHECK(strain_at(0.11) == Approx(7.5e-4).epsilon(2e-3));
  CHECK(strain_at(0.26) == Approx(1e-3).epsilon(2e-3));
  CHECK(strain_at(0.27) == Approx(0).margin(1e-9));
}

namespace {

// A block 0.15 mm above a plate to which it adheres, its upper face held; the factor of the adhesion follows a drive.
std::string glued(const std::string& stages) {
  return R"(time: {step: 10 ms, duration: 1 s, integrator: quasi_static}
objects:
  - {name: plate, shape: {type: box, size: [20 mm, 2 mm, 20 mm]}, place: {translate: [0, -1 mm, 0]}, motion: [fixed]}
  - name: block
    shape: {type: box, size: [10 mm, 10 mm, 10 mm], cells: [2, 2, 2]}
    place: {translate: [0, 5.15 mm, 0]}
    energies: [{type: neo_hookean, young: 1 GPa, poisson: 0, density: 1000}]
    motion: [{type: fixed, select: {type: face, direction: [0, 1, 0]}}]
contact:
  distance: 0.1 mm
  pairs: [{between: [block, plate], adhesion: {type: fang, peak_traction: 1 kPa}, drive: glue}]
probes: [{name: pull, type: contact_force, on: block, from: plate, direction: [0, -1, 0]}]
solver: {type: projected_newton, tolerance: 1e-8}
protocols:
  - name: cure
    stages:
)" + stages;
}

}  // namespace

TEST_CASE("an adhesion follows a drive", "[protocol]") {
  TestRun run(glued(R"(
      - {name: whole, until: {time: 20 ms}}
      - {name: half, drive: {glue: {factor: 0.5}}, until: {time: 20 ms}}
      - {name: none, drive: {glue: {factor: 0, within: 20 ms}}, until: {time: 30 ms}}
)"));
  const auto pull_at = [&](double t) {
    while (run.state().time < t - 1e-9) run.step();
    return value(run, 0);
  };
  const double whole = pull_at(0.02);
  CHECK(whole > 0.03);
  CHECK(pull_at(0.04) == Approx(whole / 2).epsilon(0.01));
  CHECK(pull_at(0.05) == Approx(whole / 4).epsilon(0.01));
  CHECK(pull_at(0.07) == Approx(0).margin(1e-12));
}

TEST_CASE("a change of an adhesion's factor is work of the environment: at a constant gap the factor times the energy", "[protocol]") {
  TestRun run(glued(R"(
      - {name: whole, until: {time: 20 ms}}
      - {name: half, drive: {glue: {factor: 0.5}}, until: {time: 20 ms}}
      - {name: none, drive: {glue: {factor: 0, within: 30 ms}}, until: {time: 40 ms}}
      - {name: again, drive: {glue: {factor: 0.25}}, until: {time: 20 ms}}
)"));
  // Traction falls from 1 kPa at 0.1 mm to 0 at 0.2 mm; the gap is 0.15 mm, the area 1 cm^2.
  const double whole = -1e3 * 0.05e-3 * 0.05e-3 / (2 * 0.1e-3) * 1e-4;
  double factor = 1;
  const auto factor_at = [](double t) { return t < 0.025 ? 1 : t < 0.045 ? 0.5 : t < 0.075 ? 0.5 * (1 - (t - 0.04) / 0.03) : t < 0.085 ? 0 : 0.25; };
  for (int step = 0; step < 10; ++step) {
    const StepReport r = run.step();
    const double before = factor;
    factor = factor_at(run.state().time);
    INFO("at " << run.state().time << " s, factor " << factor);
    CHECK(r.flows.of("work_environment") == Approx((factor - before) * whole).epsilon(1e-3).margin(-1e-9 * whole));
    CHECK(std::abs(r.flows.areas) < -1e-3 * whole);
    CHECK(std::abs(r.flows.numerics) < -1e-3 * whole);
  }
}

TEST_CASE("first contact ends a stage", "[protocol]") {
  TestRun run(R"(time: {step: 10 ms, duration: 1 s, integrator: quasi_static}
objects:
  - {name: probe, shape: {type: box, size: [5 mm, 2 mm, 5 mm]}, place: {translate: [0, 6.5 mm, 0]}, motion: [{type: driven, drive: head, direction: [0, 1, 0]}]}
  - name: block
    shape: {type: box, size: [10 mm, 10 mm, 10 mm], cells: [2, 2, 2]}
    energies: [{type: neo_hookean, young: 100 kPa, poisson: 0, density: 1000}]
    motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}]
contact: {distance: 0.1 mm}
probes: [{name: gap, type: gap, between: [probe, block]}]
protocols: [{name: touch, stages: [{name: down, drive: {head: {velocity: -1.7 mm/s}}, until: {contact: [probe, block]}}]}]
)");
  run_through(run);
  CHECK(value(run, 0) == Approx(0.1e-3).epsilon(0.0101));
  CHECK(run.state().time == Approx(0.4e-3 / 1.7e-3).epsilon(0.004));
}

TEST_CASE("a stage that never ends is an error with the last value of its probe", "[protocol]") {
  TestRun run(block(stage("name: load, " + down + ", until: {probe: force, above: 1 kN}"), "integrator: quasi_static", ""));
  run_through(run);
  CHECK_THROWS_WITH(run.simulation.check_stages(), Catch::Contains("stage 'load' began at 0 s and has not ended when the run ends, at 2 s: force was last 2.") &&
                                                       Catch::Contains("N, and the stage ends with force above 1000 N") && Catch::Contains("raise time.duration"));
  TestRun longest(block(stage("name: load, " + down + ", until: {probe: force, above: 1 kN}, longest: 0.055 s")));
  for (int i = 0; i < 6; ++i) longest.step();
  CHECK(longest.state().time == Approx(0.055));
  CHECK_THROWS_WITH(longest.simulation.check_stages(), Catch::Contains("within 0.055 s (longest)"));
}

TEST_CASE("what is wrong with a protocol is said before the run", "[protocol]") {
  const std::string until = ", until: {time: 1 s}";
  const auto says = [](const std::string& stages, const std::string& text) {
    INFO(text);
    CHECK_THAT(error_of<TestRun>(block(stages)), Catch::Contains(text));
  };
  says(stage("name: a, drive: {hed: {velocity: 1 mm/s}}" + until), "'head', and no stage of a protocol drives it; did you mean 'hed'?");
  says(stage("name: a, " + down + ", until: {probe: forse, above: 1 N}"), "no probe has the column 'forse'; did you mean 'force'?");
  says(stage("name: a, " + down + ", until: {probe: force, above: 1 mm}"), "above: expects a");
  says(stage("name: a, " + down + ", until: {probe: force}"), "give one of above, below, rate_below and drop");
  says(stage("name: a, " + down + ", until: {time: 1 s, probe: force, above: 1 N}"), "give one of time, probe, contact and when");
  says(stage("name: a, " + down + ", until: {when: forse > 1}"), "forse");
  says(stage("name: a, " + down + ", until: {contact: [block, blok]}"), "contact: the scene has none");
  says(stage("name: a, drive: {head: {velocity: 1 deg/s}}" + until), "velocity: expects a velocity");
  says(stage("name: a, drive: {head: {velocity: 1 mm/s, position: 1 mm}}" + until), "give one of velocity, position, factor, formula and control");
  says(stage("name: a, drive: {head: {position: 1 mm}}" + until), "position needs the speed");
  says(stage("name: a, drive: {head: {factor: 1}}" + until), "factor is of loads and adhesion");
  says(stage("name: a, drive: {head: {control: force, target: 1 N}}" + until), "control needs the largest speed");
  says(stage("name: a, drive: {head: {control: force, target: 0 N, speed: 1 mm/s}}" + until), "a target of zero needs a tolerance");
  says(stage("name: a, drive: {head: {control: force, target: 1 mm, speed: 1 mm/s}}" + until), "target: expects a force");
  says(stage("name: a, " + down) + stage("name: b" + until), "stage 'a' has no `until`");
  says(stage("name: a, " + down + until + ", next: c") + stage("name: b" + until), "goes on to 'c', which is no stage");
  says(stage("name: a, " + down + until + ", repeat: 2"), "needs `next`");
  says(stage("name: a, " + down + ", until: {time: 0 s}, next: a, repeat: 2"), "a stage of 0 s goes to the stage below");
  says(stage("name: a, " + down + until) + stage("name: a" + until), "two stages are named 'a'");
  CHECK_THAT(error_of<TestRun>(block(stage("name: a, " + down + until), "integrator: quasi_static", "expect: [{probe: force, statistic: max, stage: b, at_least: 0}]")),
             Catch::Contains("no protocol has a stage 'b'"));
}

TEST_CASE("units are those of the scene", "[protocol]") {
  TestRun si(block(stage("name: a, drive: {head: {velocity: -0.001}}, until: {probe: force, above: 0.05}")));
  TestRun others(block(stage("name: a, drive: {head: {velocity: -60 mm/min}}, until: {probe: force, above: 50 mN}")));
  run_through(si);
  run_through(others);
  CHECK(si.state().time == Approx(others.state().time).epsilon(1e-12));
}

TEST_CASE("a protocol has the same bits for any number of threads", "[protocol]") {
  const std::string stages = stage("name: load, " + down + ", until: {probe: force, above: 0.05 N}") +
                             stage("name: hold, drive: {head: {control: force, target: 0.03 N, speed: -5 mm/s}}, until: {time: 0.1 s}");
  std::vector<VecX> ends;
  for (const size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    TestRun run(block(stages, "integrator: bdf2"));
    run_through(run);
    ends.push_back(run.state().x);
  }
  CHECK(ends[0] == ends[1]);
  CHECK(ends[0] == ends[2]);
}

TEST_CASE("steps of a protocol that are rejected are cut back, and the ends of its stages stay", "[protocol]") {
  std::string text = block(stage("name: load, " + down + ", until: {probe: force, above: 0.05 N}") +
                           stage("name: hold, drive: {head: {control: force, target: 0.03 N, speed: -5 mm/s}}, until: {time: 0.1 s}"));
  TestRun easy(text);
  run_through(easy);
  // The first steps of the control, which go back by more than the others, take three iterations.
  text.replace(text.find("tolerance: 1e-8"), 15, "tolerance: 1e-8, max_iterations: 2");
  TestRun hard(text);
  int rejected = 0;
  while (!hard.simulation.finished()) rejected += hard.step().rejections.cutbacks();
  CHECK(rejected > 0);
  CHECK(value(hard, 0) == Approx(0.03).epsilon(1e-3));
  CHECK(visits(hard)[0].end == Approx(visits(easy)[0].end).epsilon(1e-9));
  CHECK(hard.state().time == Approx(easy.state().time).epsilon(1e-9));
}

TEST_CASE("a changed scene goes on from where it is", "[protocol]") {
  const auto load = [](const std::string& velocity, const std::string& young) {
    std::string text = block(stage("name: load, drive: {head: {velocity: " + velocity + "}}, until: {probe: height, below: 9.7 mm, within: 1 nm}"));
    text.replace(text.find("young: 100 kPa"), 14, "young: " + young);
    return parse_experiment("name: test\n" + text, "test.yaml");
  };
  Simulation before(load("-1 mm/s", "100 kPa"));
  before.start();
  for (int i = 0; i < 10; ++i) before.step();
  Simulation after(load("-2 mm/s", "200 kPa"));
  after.start_from(changed_state(before, after));
  after.step();
  ProbeSet probes = probes_of(after.built());
  const std::vector<double> values = probes.sample(after.world(), after.state());
  CHECK(values[1] == Approx(10e-3 - 0.1e-3 - 0.02e-3).epsilon(1e-9));
  CHECK(values[0] == Approx(0.12e-3 / 10e-3 * 200e3 * 1e-4).epsilon(0.05));
  while (!after.finished()) after.step();
  CHECK(after.state().time == Approx(0.1 + 0.1).epsilon(1e-5));
}

TEST_CASE("a run that is resumed within a stage has the bits of one that is not", "[protocol]") {
  const TemporaryFolder folder;
  const std::string control = "drive: {head: {control: force, target: 0.03 N, speed: -5 mm/s}}";
  std::string text = block(stage("name: load, " + down + ", until: {probe: force, above: 0.05 N}") + stage("name: hold, " + control + ", until: {time: 0.1 s}") +
                           stage("name: up, drive: {head: {velocity: 1 mm/s}}, until: {probe: force, drop: 90 %}, next: load, repeat: 1"), "integrator: bdf2",
                           "output: {frames: false, checkpoint_interval: 0.02 s}\n");
  text.replace(text.find("output: {frames: false}\n"), 24, "");
  write_file(folder.path() / "scene.yaml", "name: test\n" + text);
  const ProgramResult first = run_tack(folder.path(), {"run", "scene.yaml", "-o", "whole"});
  INFO(first.out << first.err);
  REQUIRE(first.exit_code == 0);
  const fs::path whole = folder.path() / "whole", parts = folder.path() / "parts";
  CHECK(read_json(whole / "summary.json")["stages"].size() == 6);
  for (const int steps : {3, 17, 29}) {
    INFO(steps);
    fs::remove_all(parts);
    REQUIRE(run_tack(folder.path(), {"run", "scene.yaml", "-o", "parts", "--steps", std::to_string(steps)}).exit_code == 0);
    const ProgramResult resumed = run_tack(folder.path(), {"run", "scene.yaml", "-o", "parts", "--resume"});
    INFO(resumed.out << resumed.err);
    REQUIRE(resumed.exit_code == 0);
    CHECK(file_text(parts / "probes.csv") == file_text(whole / "probes.csv"));
    CHECK(file_text(parts / "stages.csv") == file_text(whole / "stages.csv"));
  }
}
