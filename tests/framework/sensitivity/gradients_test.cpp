// Sensitivities of probes, compared with central differences of whole runs and closed forms.
#include "framework/sensitivity/gradients.hpp"

#include <catch2/catch.hpp>
#include <sstream>

#include "framework/output/csv.hpp"
#include "framework/run/gradient_check.hpp"
#include "framework/run/recorded_run.hpp"
#include "tests/support/program.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;
using Catch::Matchers::Contains;

namespace {

LoadedExperiment scene(const std::string& text) { return parse_experiment("name: test\n" + text, "test.yaml"); }

// Returns the largest error against finite differences of runs, relative to the largest difference.
double worst(const std::string& text, const std::string& probe, const std::string& key, double step = 1e-5) {
  const GradientCheck c = check_gradient(scene(text), probe, key, step);
  REQUIRE(c.times.size() > 3);
  REQUIRE(c.largest > 0);
  for (const Warning& warning : c.warnings) UNSCOPED_INFO(warning.text);
  UNSCOPED_INFO(probe << " by " << key << ": at " << c.times[c.worst] << " s " << c.gradients[c.worst] << ", differences " << c.differences[c.worst]);
  return c.error(c.worst);
}

// A block of 10 mm that hangs from its top and is pulled down at its bottom.
const std::string drawn = R"(
time: {step: 0.1 s, duration: 0.4 s, integrator: quasi_static}
objects:
  - name: block
    shape: {type: box, size: [10 mm, 10 mm, 10 mm], cells: [2, 2, 2]}
    energies: [{type: neo_hookean, young: 1 MPa, poisson: 0, density: 1000}]
    motion: [{type: fixed, select: {type: face, direction: [0, 1, 0]}}]
    loads: [{type: traction, value: [0, -100, 0], ramp: [[0 s, 0], [0.4 s, 1]], select: {type: face, direction: [0, -1, 0]}}]
solver: {tolerance: 1e-12}
probes:
  - {name: middle, type: centre_of_mass, object: block, direction: [0, 1, 0]}
)";

// A soft block between a floor and a descending plate.
const std::string pressed = R"(
time: {step: 0.1 s, duration: 1 s, integrator: quasi_static}
objects:
  - {name: floor, shape: {type: box, size: [30 mm, 2 mm, 30 mm], cells: [3, 1, 3]}, place: {translate: [0, -1 mm, 0]}, motion: [fixed]}
  - name: block
    shape: {type: box, size: [10 mm, 10 mm, 10 mm], cells: [3, 3, 3]}
    place: {translate: [0, 5.3 mm, 0]}
    energies: [{type: neo_hookean, young: 100 kPa, poisson: 0.3, density: 1000}]
    motion:
      - {type: fixed, along: [1, 0, 0], select: {type: face, direction: [-1, 0, 0]}}
      - {type: fixed, along: [0, 0, 1], select: {type: face, direction: [0, 0, -1]}}
  - name: plate
    shape: {type: box, size: [20 mm, 2 mm, 20 mm], cells: [2, 1, 2]}
    place: {translate: [0, 11.7 mm, 0]}
    motion: [{type: translate, velocity: [0, -2 mm/s, 0]}]
contact: {distance: 0.5 mm, barrier: {stiffness: 1e6}}
solver: {force_tolerance: 1e-8, linear: multifrontal}
probes:
  - {name: force, type: reaction, object: plate, direction: [0, 1, 0]}
)";

// Two adhesive plates are pulled apart until they detach suddenly. The lower one is no square: where both plates have a mirror plane on the diagonal, rounding
// decides between patches at equal distances, and a scene that is changed by a millionth decides otherwise than the run.
const std::string parted = R"(
time: {step: 10 ms, duration: 0.36 s}
objects:
  - {name: upper, shape: {type: box, size: [20 mm, 4 mm, 20 mm], cells: [3, 1, 3]}, place: {translate: [0, 2.125 mm, 0]}, motion: [fixed]}
  - name: lower
    shape: {type: box, size: [20 mm, 4 mm, 19 mm], cells: [4, 1, 4]}
    place: {translate: [0, -2.125 mm, 0]}
    energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3, density: 1000}]
    loads: [{type: traction, value: [0, -1000, 0], ramp: [[0 s, 0], [0.35 s, 1.1]], select: {type: face, direction: [0, -1, 0]}}]
contact:
  distance: 1 mm
  pairs: [{between: [lower, upper], adhesion: {type: fang, peak_traction: 1 kPa, form: squared}}]
solver: {tolerance: 1e-12}
probes:
  - {name: force, type: contact_force, on: lower, from: upper, direction: [0, 1, 0]}
  - {name: height, type: centre_of_mass, object: lower, direction: [0, 1, 0]}
)";

// The end of a tape on a desk is lifted.
const std::string peeled = R"(
time: {step: 10 ms, duration: 0.2 s}
objects:
  - {name: desk, shape: {type: box, size: [30 mm, 4 mm, 10 mm], cells: [7, 1, 3]}, place: {translate: [0, -2 mm, 0]}, motion: [fixed]}
  - name: tape
    shape: {type: grid, size: [20 mm, 3 mm], cells: [20, 3]}
    place: {translate: [0, 0.2 mm, 0]}
    shell: {thickness: 0.3 mm}
    energies: [{type: stvk_membrane, young: 10 MPa, poisson: 0, density: 1000}, {type: hinge_bending, young: 10 MPa, poisson: 0}]
    motion:
      - {type: fixed, select: {type: face, direction: [-1, 0, 0]}}
      - {type: translate, velocity: [0, 20 mm/s, 0], select: {type: face, direction: [1, 0, 0]}}
contact:
  distance: 0.2 mm
  pairs:
    - {between: [tape, desk], adhesion: {type: fang, peak_traction: 1 kPa, form: squared}}
    - {between: [tape, tape], contact: false}
solver: {tolerance: 1e-11, linear: multifrontal}
probes:
  - {name: force, type: reaction, object: tape, select: {type: face, direction: [1, 0, 0]}, direction: [0, 1, 0]}
)";

// A block slides on a plane inclined by 30 degrees; gravity is inclined instead of the plane.
std::string slid(const std::string& lagging) {
  return R"(
time: {step: 10 ms, duration: 0.2 s}
gravity: [4.9, -8.5, 0]
objects:
  - {name: floor, shape: {type: box, size: [300 mm, 10 mm, 60 mm], cells: [5, 1, 2]}, place: {translate: [50 mm, -5 mm, 0]}, motion: [fixed]}
  - name: block
    shape: {type: box, size: [40 mm, 20 mm, 40 mm], cells: [2, 1, 2]}
    place: {translate: [0, 10.9 mm, 0]}
    energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3, density: 1000}]
contact: {distance: 1 mm, barrier: {stiffness: 2 kPa}, friction: {mu: 0.3}, lagging: )" + lagging + R"(}
solver: {tolerance: 1e-9}
probes:
  - {name: place, type: centre_of_mass, object: block, direction: [1, 0, 0]}
  - {name: lost, type: energy, term: dissipated_friction}
)";
}

// A block falls on a floor and rebounds.
std::string bounced(const std::string& integrator) {
  return R"(
time: {step: 2 ms, duration: 0.06 s, integrator: )" + integrator + R"(}
gravity: [0, -9.81, 0]
objects:
  - {name: floor, shape: {type: box, size: [60 mm, 10 mm, 60 mm], cells: [2, 1, 2]}, place: {translate: [0, -5 mm, 0]}, motion: [fixed]}
  - name: block
    shape: {type: box, size: [20 mm, 20 mm, 20 mm], cells: [2, 2, 2]}
    place: {translate: [0, 13 mm, 0]}
    velocity: [0, -0.1, 0]
    energies: [{type: neo_hookean, young: 100 kPa, poisson: 0.3, density: 1000}]
contact: {distance: 2 mm, barrier: {stiffness: 5 kPa}}
solver: {tolerance: 1e-10}
probes:
  - {name: height, type: centre_of_mass, object: block, direction: [0, 1, 0]}
)";
}

}  // namespace

TEST_CASE("derivatives that cannot be found are warned of", "[sensitivity]") {
  const auto warnings = [](const std::string& text, const std::string& gradient) {
    const TemporaryFolder folder;
    RunSettings settings;
    settings.output = (folder.path() / "results").string();
    std::ostringstream printed;
    RecordedRun run(scene(text + "output: {frames: false, gradients: [" + gradient + "]}\n"), settings, Provenance(), printed, {});
    std::vector<Warning> given;
    for (const WarningCount& w : run.execute().warnings) given.push_back(w.first);
    return given;
  };
  // With the change the plate leaves the block.
  CHECK_THAT(first_text(warnings(pressed, "{key: objects.plate.motion.0.velocity.1, step: 0.1}"), WarningKind::gradient_not_converged), Contains("'objects.plate.motion.0.velocity.1'"));
  CHECK_FALSE(warned(warnings(drawn, "{key: objects.block.energies.0.young}"), WarningKind::gradient_not_converged));
  // A spring breaks one step earlier with the change.
  const std::string torn = R"(
time: {step: 0.1 s, duration: 0.5 s}
objects:
  - {name: wall, shape: {type: box, size: [0.1, 0.1, 0.1]}, motion: [fixed]}
  - {name: hook, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [1, 0, 0]}, motion: [{type: translate, velocity: [1, 0, 0]}]}
  - {name: ball, shape: {type: points}, place: {translate: [0, 1, 0]}, particle: {radius: 1 cm}, energies: [{type: particle, mass: 1}]}
interactions: [{type: spring, name: wire, from: {object: wall, select: {type: indices, vertices: [0]}}, to: {object: hook, select: {type: indices, vertices: [0]}}, stiffness: 10 N/m, breaking_force: 2.0000001}]
probes: [{name: height, type: centre_of_mass, object: ball, direction: [0, 1, 0]}]
)";
  CHECK_THAT(first_text(warnings(torn, "{key: interactions.wire.stiffness}"), WarningKind::gradient_jump), Contains("'interactions.wire.stiffness'"));
  // Two springs press on a ball that could leave their line.
  const std::string unstable = R"(
time: {step: 0.1 s, duration: 0.3 s, integrator: quasi_static}
objects:
  - {name: left, shape: {type: points}, place: {translate: [-1, 0, 0]}, particle: {radius: 1 cm}, energies: [{type: particle, mass: 1}], motion: [fixed]}
  - {name: right, shape: {type: points}, place: {translate: [1, 0, 0]}, particle: {radius: 1 cm}, energies: [{type: particle, mass: 1}], motion: [fixed]}
  - {name: ball, shape: {type: points}, particle: {radius: 1 cm}, energies: [{type: particle, mass: 1}]}
interactions:
  - {type: spring, name: one, from: {object: left}, to: {object: ball}, stiffness: 10 N/m, length: 2 m}
  - {type: spring, name: two, from: {object: right}, to: {object: ball}, stiffness: 10 N/m, length: 2 m}
probes: [{name: height, type: centre_of_mass, object: ball, direction: [0, 1, 0]}]
)";
  first_text(warnings(unstable, "{key: interactions.one.stiffness}"), WarningKind::indefinite_hessian);
}

TEST_CASE("sensitivities of a stretched block agree with Hooke's law", "[sensitivity]") {
  const GradientCheck c = check_gradient(scene(drawn), "middle", "objects.block.energies.0.young", 1e-4);
  REQUIRE(c.times.size() == 5);
  CHECK(c.gradients.front() == 0);
  CHECK(c.error(c.worst) < 1e-5);
  // The middle goes down by L t / 2 E, at a strain of 1e-4.
  CHECK(c.gradients.back() == Approx(0.5 * 1e-2 * 100 / 1e12).epsilon(1e-3));
  CHECK(c.number == 1e6);
}

// Parameters by either name, in a sum of an expression, and with the name of a unit.
TEST_CASE("sensitivities to parameters with units agree with those to the keys that use them", "[sensitivity]") {
  std::string text = drawn;
  text.replace(text.find("young: 1 MPa"), 12, "young: stiff / 2 + s");
  text += "parameters: {stiff: 1 MPa, s: 0.5 MPa}\n";
  const GradientCheck direct = check_gradient(scene(drawn), "middle", "objects.block.energies.0.young", 1e-4);
  // Both are differences by 1e-6 of the parameter, solved to 1e-6 of themselves (perturbed_scene.cpp): 1e-6 of a parameter that is
  // half of the modulus is 5e-7 of it, so that the two may differ by 2e-6 + 5e-7.
  constexpr double accuracy = 2.5e-6;
  for (const auto& [key, number, factor] : {std::tuple("stiff", 1e6, 0.5), std::tuple("parameters.stiff", 1e6, 0.5), std::tuple("s", 5e5, 1.0)}) {
    INFO(key);
    const GradientCheck c = check_gradient(scene(text), "middle", key, 1e-4);
    CHECK(c.number == number);
    CHECK(c.error(c.worst) < 1e-5);
    CHECK(c.gradients.back() == Approx(factor * direct.gradients.back()).epsilon(accuracy));
  }
}

TEST_CASE("sensitivities of a pressed block agree with differences of runs", "[sensitivity]") {
  for (const char* key : {"objects.block.energies.0.young", "contact.barrier.stiffness"}) CHECK(worst(pressed, "force", key, 1e-4) < 1e-4);
  // Derivatives by these numbers are less accurate: they change the force residuals of the runs.
  for (const char* key : {"objects.block.energies.0.poisson", "contact.distance", "objects.plate.motion.0.velocity.1"})
    CHECK(worst(pressed, "force", key, 1e-4) < 1e-3);
}

// The block can slide and rotate, and is unstable against rotation; only its force has a sensitivity.
TEST_CASE("sensitivities of a pressed block without lateral support agree with differences of runs", "[sensitivity]") {
  std::string loose = pressed;
  const size_t from = loose.find("    motion:\n"), to = loose.find("  - name: plate");
  loose.erase(from, to - from);
  for (const char* key : {"objects.block.energies.0.young", "contact.barrier.stiffness"}) CHECK(worst(loose, "force", key, 1e-4) < 1e-4);
  // A thousand times larger, and a thousand times stiffer.
  for (const auto& [small, large] : {std::pair(" mm", " m"), std::pair("1e6", "1e9"), std::pair("100 kPa", "100 MPa")})
    for (size_t at = loose.find(small); at != loose.npos; at = loose.find(small, at + 1)) loose.replace(at, std::string(small).size(), large);
  CHECK(worst(loose, "force", "objects.block.energies.0.young", 1e-4) < 1e-4);
}

// Increments of 1e-4: the end of a step is known to 1e-14 m (1e-12 m/s), a thousandth of what an increment of 1e-6 changes, and a hundred-thousandth here.
TEST_CASE("sensitivities of suddenly detaching plates agree with differences of runs", "[sensitivity]") {
  for (const char* key : {"contact.pairs.0.adhesion.peak_traction", "objects.lower.energies.0.young", "objects.lower.loads.0.value.1"})
    CHECK(worst(parted, "height", key, 1e-4) < 1e-4);
  CHECK(worst(parted, "force", "contact.pairs.0.adhesion.peak_traction", 1e-4) < 1e-4);
}

TEST_CASE("sensitivities of a peeled tape agree with differences of runs", "[sensitivity]") {
  for (const char* key : {"contact.pairs.0.adhesion.peak_traction", "objects.tape.energies.1.young"}) CHECK(worst(peeled, "force", key, 1e-6) < 1e-4);
}

TEST_CASE("sensitivities with lagged and iterated friction agree with differences of runs", "[sensitivity]") {
  for (const char* lagging : {"{iterations: 1}", "{iterations: 30, until: 1e-9}"}) {
    CHECK(worst(slid(lagging), "place", "contact.friction.mu", 1e-6) < 1e-4);
    CHECK(worst(slid(lagging), "lost", "contact.friction.mu", 1e-6) < 1e-3);
  }
}

TEST_CASE("sensitivities of impacts agree with differences of runs, with every integrator", "[sensitivity]") {
  for (const char* integrator : {"implicit_euler", "newmark", "bdf2"}) {
    INFO(integrator);
    CHECK(worst(bounced(integrator), "height", "objects.block.energies.0.young", 1e-6) < 1e-3);
    CHECK(worst(bounced(integrator), "height", "objects.block.velocity.1", 1e-6) < 1e-3);
  }
}

TEST_CASE("sensitivities of plastic flow agree with a closed form", "[sensitivity]") {
  const GradientCheck c = check_gradient(scene(R"(
time: {step: 0.1 s, duration: 1 s, integrator: quasi_static}
objects:
  - name: bar
    shape: {type: box, size: [60 mm, 10 mm, 10 mm], cells: [3, 1, 1]}
    energies: [{type: von_mises, young: 1 GPa, poisson: 0.3, density: 1000, yield_stress: 5 MPa}]
    motion:
      - {type: fixed, along: [1, 0, 0], select: {type: face, direction: [-1, 0, 0]}}
      - {type: fixed, along: [0, 1, 0], select: {type: face, direction: [0, -1, 0]}}
      - {type: fixed, along: [0, 0, 1], select: {type: face, direction: [0, 0, -1]}}
      - {type: translate, velocity: [0.6 mm/s, 0, 0], along: [1, 0, 0], select: {type: face, direction: [1, 0, 0]}}
solver: {force_tolerance: 1e-8, linear: multifrontal}
probes:
  - {name: force, type: reaction, object: bar, direction: [1, 0, 0], select: {type: face, direction: [1, 0, 0]}}
)"), "force", "objects.bar.energies.0.yield_stress", 1e-5);
  // A sigma_y / s once it flows, s the stretch; elastic before.
  CHECK(std::abs(c.gradients[3]) < 1e-9);
  CHECK(c.gradients.back() == Approx(1e-4 / 1.01).epsilon(1e-4));
}

TEST_CASE("parameters without sensitivities are refused", "[sensitivity]") {
  const auto refused = [](const std::string& text, const std::string& key, const std::string& why, const std::string& more = "") {
    const std::string asked = text + "output: {gradients: [{key: " + key + more + "}]}\n";
    Simulation simulation(scene(asked));
    CHECK_THROWS_WITH(Gradients(simulation.built()), Contains(why));
  };
  refused(drawn, "time.step", "is a setting of the run");
  refused(drawn, "objects.block.energies.0.yuong", "is no key of the scene");
  refused(drawn, "objects.block.energies.0.poisson", "is zero");
  refused(drawn, "objects.block.shape.type", "not a number");
  refused(drawn, "objects.block.shape.cells.0", "whole");
  CHECK_THROWS_WITH(scene(drawn + "output: {gradients: [{key: a}, {key: a}]}\n"), Contains("two of them are named 'a'"));
  const Simulation asked(scene(drawn));
  GradientConfig config;
  config.key = "time.step";
  CHECK_THAT(Gradients::reason_without(asked.built(), config), Catch::StartsWith("'time.step' is a setting of the run"));
  config.key = "objects.block.energies.0.young";
  CHECK(Gradients::reason_without(asked.built(), config).empty());
  Simulation simulation(scene(drawn + "output: {gradients: [{key: objects.block.energies.0.poisson, step: 1e-6}]}\n"));
  CHECK_NOTHROW(Gradients(simulation.built()));
}

TEST_CASE("a run with gradients has the bits of a run without, also when resumed", "[sensitivity]") {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& name, bool with, int steps, bool resume) {
    RunSettings settings;
    settings.output = (folder.path() / name).string();
    settings.steps = steps;
    settings.resume = resume;
    std::ostringstream log;
    const std::string gradients = with ? ", gradients: [{key: contact.friction.mu, as: mu}, {key: objects.block.energies.0.young}]" : "";
    RecordedRun recorded(scene(slid("{iterations: 1}") + "output: {frames: false, checkpoint_interval: 50 ms" + gradients + "}\n"), settings, Provenance(), log, {});
    CHECK(recorded.execute().status == RunStatus::done);
    return folder.path() / name;
  };
  const auto without = run("without", false, 0, false), with = run("with", true, 0, false);
  CHECK(file_text(without / "probes.csv") == file_text(with / "probes.csv"));
  CHECK_FALSE(std::filesystem::exists(without / "gradients.csv"));
  const CsvTable table = read_csv(with / "gradients.csv");
  CHECK(table.columns == std::vector<std::string>{"time", "d(place)/d(mu)", "d(lost)/d(mu)", "d(place)/d(objects.block.energies.0.young)",
                                                  "d(lost)/d(objects.block.energies.0.young)"});
  CHECK(table.rows.size() == 21);
  CHECK(table.rows.back()[1] < -1e-3);
  run("resumed", true, 13, false);
  const auto resumed = run("resumed", true, 0, true);
  CHECK(file_text(resumed / "gradients.csv") == file_text(with / "gradients.csv"));
}

// Scenes with every kind of state of a perturbed scene; only one of them has a probe of dissipation.
TEST_CASE("runs with gradients and checkpoints continue, and resumed runs have equal sensitivities", "[sensitivity]") {
  const TemporaryFolder folder;
  struct Case {
    std::string name, text, key;
  };
  std::vector<Case> cases{{"drawn", drawn, "objects.block.energies.0.young"}, {"pressed", pressed, "contact.barrier.stiffness"},
                          {"parted", parted, "contact.pairs.0.adhesion.peak_traction"}, {"peeled", peeled, "contact.pairs.0.adhesion.peak_traction"},
                          {"slid", slid("{iterations: 1}"), "contact.friction.mu"}, {"iterated", slid("{iterations: 30, until: 1e-9}"), "contact.friction.mu"}};
  for (const char* integrator : {"implicit_euler", "newmark", "bdf2"}) cases.push_back({integrator, bounced(integrator), "objects.block.velocity.1"});
  for (const std::string more : {"springs", "bonds"}) {
    const bool springs = more == "springs";
    const std::string hung = R"(
time: {step: 1 ms, duration: 1 s}
gravity: [0, -9.81, 0]
objects:
  - {name: ceiling, shape: {type: box, size: [30 mm, 2 mm, 30 mm], cells: [2, 1, 2]}, place: {translate: [0, 1.05 mm, 0]}, motion: [fixed]}
  - name: block
    shape: {type: box, size: [10 mm, 10 mm, 10 mm], cells: [2, 2, 2]}
    place: {translate: [0, -5 mm, 0]}
    energies: [{type: von_mises, young: 1 MPa, poisson: 0.3, density: 1000, yield_stress: 1 kPa}]
)" + std::string(springs ? R"(interactions: [{type: spring, stiffness: 10 N/m, from: {object: block, select: {type: face, direction: [0, 1, 0]}}, to: {object: ceiling}}]
)" : R"(contact: {distance: 0.04 mm, pairs: [{between: [block, ceiling], bond_distance: 0.06 mm, adhesion: {type: rcc, normal_stiffness: 1e8 Pa/m, work_of_adhesion: 1 J/m^2}}]}
)") + "probes: [{name: height, type: centre_of_mass, object: block, direction: [0, 1, 0]}]\nsolver: {tolerance: 1e-9}\n";
    cases.push_back({more, hung, "objects.block.energies.0.young"});
  }
  for (const Case& c : cases) {
    INFO(c.name);
    const auto run = [&](const std::string& name, const char* interval, int steps, bool resume) {
      RunSettings settings;
      settings.output = (folder.path() / c.name / name).string();
      settings.steps = steps;
      settings.resume = resume;
      std::ostringstream log;
      const std::string output = fmt::format("output: {{frames: false{}, gradients: [{{key: {}}}]}}\n", interval, c.key);
      RecordedRun recorded(scene(c.text + output), settings, Provenance(), log, {});
      CHECK(recorded.execute().status == RunStatus::done);
      return read_csv(folder.path() / c.name / name / "gradients.csv");
    };
    const CsvTable without = run("without", "", 4, false), with = run("with", ", checkpoint_interval: 1 us", 4, false);
    run("resumed", ", checkpoint_interval: 1 us", 2, false);
    const CsvTable resumed = run("resumed", ", checkpoint_interval: 1 us", 4, true);
    CHECK(resumed.rows == with.rows);
    REQUIRE(with.rows.size() == 5);
    for (size_t k = 1; k < with.rows[4].size(); ++k) CHECK(with.rows[4][k] == Approx(without.rows[4][k]).epsilon(1e-3).margin(1e-3 * std::abs(without.rows[4][1])));
  }
}
