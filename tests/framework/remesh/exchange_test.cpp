// Runs in which the tets of objects are replaced as they flow.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <sstream>
#include <tbb/global_control.h>

#include "framework/core/records.hpp"
#include "framework/run/recorded_run.hpp"
#include "framework/world/energy_records.hpp"
#include "geometry/errors.hpp"
#include "tests/support/json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

// A block between plates to which it sticks, of which the upper one comes down. Lengths are times `scale`.
std::string squashed(const std::string& remesh, double scale = 1, const std::string& more = "") {
  const auto l = [&](double length) { return fmt::format("{:.9g}", length * scale); };
  return "name: squashed\ntime: {step: 20 ms, duration: 0.6 s, integrator: quasi_static}\n"
         "objects:\n"
         "  - name: block\n"
         "    shape: {type: box, size: [" + l(0.02) + ", " + l(0.02) + ", " + l(0.02) + "], cells: [4, 4, 4]}\n" + remesh +
         "    energies: [{type: von_mises, young: 100 MPa, poisson: 0.3, density: 1000, yield_stress: 1 MPa, hardening: 1 MPa}]\n"
         "  - name: bottom\n"
         "    shape: {type: box, size: [" + l(0.06) + ", " + l(0.004) + ", " + l(0.06) + "]}\n"
         "    place: {translate: [0, " + l(-0.0121) + ", 0]}\n"
         "    motion: [fixed]\n"
         "  - name: top\n"
         "    shape: {type: box, size: [" + l(0.06) + ", " + l(0.004) + ", " + l(0.06) + "]}\n"
         "    place: {translate: [0, " + l(0.0121) + ", 0]}\n"
         "    motion: [{type: keyframes, frames: [{time: 0 s}, {time: 0.6 s, translation: [0, " + l(-0.014) + ", 0]}]}]\n"
         "contact: {distance: " + l(2e-4) + ", friction: {mu: 1, eps_v: " + l(1e-3) + "}}\n"
         "probes: [{name: force, type: contact_force, on: top, from: block, direction: [0, 1, 0]}]\n" + more;
}

const std::string anew = "    remesh: {quality: 0.4, goal: 0.5}\n";

LoadedExperiment loaded(const std::string& yaml) { return parse_experiment(yaml, "scene.yaml"); }

// A run whose exchanges can be looked at.
struct Run {
  explicit Run(const std::string& yaml) : simulation(loaded(yaml), [this](const Warning& w) { warnings.push_back(w); }) { simulation.start(); }

  // Returns true if elements were exchanged after the step.
  bool step() {
    simulation.step();
    std::vector<NewElements> elements = simulation.due_elements();
    if (elements.empty()) return false;
    before = simulation.state();
    last = elements;
    lost = simulation.exchange(std::move(elements));
    return true;
  }
  const Body& body(int i = 0) const { return simulation.world().bodies[i]; }

  std::vector<Warning> warnings;
  Simulation simulation;
  State before;  // the last exchange
  std::vector<NewElements> last;
  double lost = 0;
};

// Quantities of the whole first body.
struct Whole {
  explicit Whole(const World& world, const State& s) {
    for (const int v : world.vertices_of(0)) {
      const Vec3 mv = world.mass(v) * vertex(s.v, v);
      mass += world.mass(v);
      momentum += mv;
      spin += Vec3(vertex(s.x, v)).cross(mv);
    }
    for (const NamedEnergy& e : energies_by_term(world, s))
      if (e.kind == EnergyKind::motion || e.kind == EnergyKind::of_objects) energy += e.value;
    const ExchangeableTets& tets = world.records.exchangeable().front();
    const std::vector<double> volumes = tets.volumes(), flows = tets.plastic_strains();
    for (size_t t = 0; t < volumes.size(); ++t) volume += volumes[t], flow += volumes[t] * flows[t];
  }
  double mass = 0, energy = 0, volume = 0, flow = 0;
  Vec3 momentum = Vec3::Zero(), spin = Vec3::Zero();
};

// A block that is thrown, spinning, against a wall.
const std::string thrown =
    "name: thrown\ntime: {step: 0.05 ms, duration: 4 ms, integrator: bdf2}\n"
    "objects:\n"
    "  - name: block\n"
    "    shape: {type: box, size: [0.02, 0.02, 0.02], cells: [4, 4, 4]}\n"
    "    place: {translate: [0, 0.0102, 0]}\n"
    "    velocity: [2, -25, 0]\n"
    "    spin: [0, 50, 100]\n"
    "    remesh: {quality: 0.5, goal: 0.6}\n"
    "    energies: [{type: von_mises, young: 10 MPa, poisson: 0.3, density: 1000, yield_stress: 0.1 MPa, hardening: 0.1 MPa}]\n"
    "  - {name: wall, shape: {type: box, size: [0.2, 0.02, 0.2]}, place: {translate: [0, -0.01, 0]}, motion: [fixed]}\n"
    "contact: {distance: 0.2 mm, friction: {mu: 0.3}}\n";

}  // namespace

TEST_CASE("a block in uniform plastic compression continues with new tets as without", "[remesh]") {
  const auto bar = [](const std::string& remesh) {
    return "name: bar\ntime: {step: 0.05, duration: 1, integrator: quasi_static}\n"
           "solver: {type: projected_newton, force_tolerance: 1e-9}\n"
           "objects: [{name: bar, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [4, 4, 4]}," + remesh +
           "  energies: [{type: von_mises, young: 1e6, poisson: 0.3, yield_stress: 1e4, hardening: 1e4}],\n"
           "  motion: [{type: fixed, along: [1, 0, 0], select: {type: face, direction: [-1, 0, 0]}},\n"
           "    {type: fixed, along: [0, 1, 0], select: {type: face, direction: [0, -1, 0]}},\n"
           "    {type: fixed, along: [0, 0, 1], select: {type: face, direction: [0, 0, -1]}},\n"
           "    {type: translate, along: [0, 1, 0], displacement: [0, -0.06, 0], duration: 1, select: {type: face, direction: [0, 1, 0]}}]}]\n";
  };
  // Largest deviation of all tets' stresses from their mean, relative to it.
  const auto stresses = [](const Run& run, Mat3& mean) {
    const std::vector<Mat3> all = run.simulation.world().records.stresses().front().values(run.simulation.state().x);
    mean = Mat3::Zero();
    for (const Mat3& s : all) mean += s / static_cast<double>(all.size());
    double off = 0;
    for (const Mat3& s : all) off = std::max(off, (s - mean).norm() / mean.norm());
    return off;
  };
  Run with(bar("remesh: {quality: 0.45, goal: 0.6}, ")), without(bar(""));
  int exchanges = 0;
  while (!with.simulation.finished()) {
    const bool exchanged = with.step();
    without.step();
    Mat3 here, there;
    const double off = stresses(with, here);
    stresses(without, there);
    CAPTURE(with.simulation.state().time, exchanged);
    CHECK(off < 1e-8);
    CHECK((here - there).norm() < 1e-8 * there.norm());
    if (!exchanged) continue;
    ++exchanges;
    CHECK(with.last[0].after > with.last[0].before);
    CHECK(with.body().tets != without.body().tets);
    const auto elastic = [](const Run& run) { return stored_energy(energies_by_term(run.simulation.world(), run.simulation.state())); };
    CHECK(elastic(with) == Approx(elastic(without)).epsilon(1e-9));
    CHECK(std::abs(with.lost) < 1e-9 * elastic(without));
  }
  CHECK(exchanges >= 1);
  CHECK(with.warnings.empty());
}

TEST_CASE("mass, momentum and plastic strain are transferred to new tets, and the energy loss is recorded", "[remesh]") {
  Run run(thrown);
  int exchanges = 0;
  while (!run.simulation.finished() && exchanges < 2) {
    run.simulation.step();
    const Whole was(run.simulation.world(), run.simulation.state());
    const std::vector<Triangle> surface = run.body().triangles;
    const State state = run.simulation.state();
    std::vector<NewElements> elements = run.simulation.due_elements();
    if (elements.empty()) continue;
    ++exchanges;
    const std::vector<int> from = elements[0].from;
    CHECK(elements[0].after > elements[0].before);
    const double lost = run.simulation.exchange(std::move(elements));
    const State& now = run.simulation.state();
    const Whole is(run.simulation.world(), now);
    CAPTURE(now.time);
    CHECK(is.mass == Approx(was.mass).epsilon(1e-12));
    CHECK(is.volume == Approx(was.volume).epsilon(1e-12));
    CHECK(is.flow == Approx(was.flow).epsilon(1e-12));
    CHECK((is.momentum - was.momentum).norm() < 1e-11 * was.momentum.norm());
    CHECK((is.spin - was.spin).norm() < 1e-11 * was.spin.norm());
    CHECK(was.energy - is.energy == Approx(lost).margin(1e-9 * was.energy));
    CHECK(now.energy.kinetic + now.energy.elastic == Approx(was.energy).epsilon(1e-9));  // until the next step subtracts the loss
    // The surface is the same one.
    REQUIRE(run.body().triangles.size() == surface.size());
    for (size_t t = 0; t < surface.size(); ++t)
      for (int i = 0; i < 3; ++i) CHECK(from[run.body().triangles[t][i]] == surface[t][i]);
    for (size_t v = 0; v < from.size(); ++v)
      if (from[v] >= 0) CHECK(Vec3(vertex(now.x, static_cast<int>(v))) == Vec3(vertex(state.x, from[v])));
    // The next step balances: the loss is in its account.
    const StepReport next = run.simulation.step();
    CHECK(next.flows.of("dissipated_remeshing") == Approx(lost));
    CHECK(std::abs(next.flows.numerics) < 0.1 * was.energy);
    CHECK_THROWS_AS(run.simulation.step(), std::logic_error);
    CHECK(run.simulation.due_elements().empty());
    CHECK(run.simulation.step().flows.of("dissipated_remeshing") == 0);
    run.simulation.due_elements();
  }
  CHECK(exchanges >= 1);
}

TEST_CASE("a run resumed before or after an exchange has the bits of an uninterrupted one, with any number of threads", "[remesh]") {
  const std::string yaml = squashed(anew, 1, "output: {checkpoint_interval: 0.1 s, frame_interval: 0.2 s}\n");
  const TemporaryFolder folder;
  const auto record = [&](const std::string& name, int steps, bool resume, int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
    RunSettings settings;
    settings.output = (folder.path() / name).string();
    settings.steps = steps;
    settings.resume = resume;
    std::ostringstream told;
    RecordedRun run(loaded(yaml), settings, {}, told, {});
    const RunSummary summary = run.execute();
    INFO(told.str());
    CHECK(summary.status == RunStatus::done);
    return summary;
  };
  const auto last = [&](const std::string& name) { return read_state_file(newest_checkpoint_in(folder.path() / name / "checkpoints"), StateFile::Kind::checkpoint); };
  const RunSummary whole = record("whole", 0, false, 2);
  REQUIRE(whole.remeshings.size() >= 2);
  const int first = whole.remeshings[0].step, second = whole.remeshings[1].step;
  CHECK(whole.remeshings[0].after > whole.remeshings[0].before);
  const State end = last("whole").state;
  // Resumes from the last step before an exchange, from the one after it, and from a step between two exchanges.
  for (const int stop : {first - 1, first + 1, second + 1}) {
    CAPTURE(stop);
    const std::string name = "part" + std::to_string(stop);
    record(name, stop, false, 1);
    const RunSummary resumed = record(name, 0, true, 1);
    CHECK(resumed.remeshings == whole.remeshings);
    CHECK(resumed.newton_iterations == whole.newton_iterations);
    const State state = last(name).state;
    CHECK(state.x == end.x);
    CHECK(state.v == end.v);
    CHECK(state.history == end.history);
    for (const char* file : {"probes.csv", "run.pvd"}) CHECK(file_text(folder.path() / name / file) == file_text(folder.path() / "whole" / file));
  }
  const auto summary = read_json(folder.path() / "whole/summary.json");
  REQUIRE(summary["remeshings"].size() == whole.remeshings.size());
  CHECK(summary["remeshings"][0]["object"] == "block");
  CHECK(summary["remeshings"][0]["quality_before"].get<double>() < 0.4);
  CHECK(summary["energy"]["dissipated_remeshing"].get<double>() > 0);
}

TEST_CASE("exchanges do not depend on the units", "[remesh]") {
  const double scale = GENERATE(1e-3, 1e3);
  CAPTURE(scale);
  Run one(squashed(anew)), other(squashed(anew, scale));
  bool exchanged = false;
  for (int i = 0; i < 28 && !exchanged; ++i) {
    exchanged = one.step();
    REQUIRE(other.step() == exchanged);
  }
  REQUIRE(exchanged);
  CHECK(other.last[0].before == Approx(one.last[0].before).epsilon(1e-4));
  // Many tets of a box are alike, and rounding decides which of them is changed first.
  CHECK(other.last[0].after == Approx(one.last[0].after).epsilon(0.1));
  const double ratio = other.lost / std::pow(scale, 3) / one.lost;
  CHECK(ratio > 0.5);
  CHECK(ratio < 2);
}

TEST_CASE("bonds stay if the tets behind them are exchanged", "[remesh]") {
  std::string yaml = squashed(anew);
  const std::string distance = "contact: {distance: 0.0002, ";
  const size_t at = yaml.find(distance);
  REQUIRE(at != yaml.npos);
  yaml.insert(at + distance.size(), "pairs: [{between: [block, bottom], adhesion: {type: rcc, normal_stiffness: 1e9 Pa/m, tangential_stiffness: 1e8 Pa/m, "
                                    "work_of_adhesion: 100 J/m^2}, bond: at_start}], ");
  Run run(yaml);
  const auto bonds = [](const State& s) {
    const auto array = s.history.at("contact/bonds/rcc");
    return std::pair(array.entries(), array.values);
  };
  int exchanges = 0;
  for (int i = 0; i < 28; ++i) {
    if (!run.step()) continue;
    ++exchanges;
    const auto [was, values_before] = bonds(run.before);
    const auto [is, values] = bonds(run.simulation.state());
    CHECK(was > 0);
    CHECK(is == was);
    CHECK(values == values_before);
    const int shift = run.body().vertex_count - run.last[0].body;
    CHECK(shift > 0);
    for (const auto& [v, object] : run.simulation.state().history.at("contact/bonds/rcc").keys) CHECK(run.simulation.world().body_of(v) != object);
  }
  CHECK(exchanges > 0);
}

TEST_CASE("tets that cannot be improved give one warning, and the run continues", "[remesh]") {
  // All vertices are on the surface, and the tets are no better than its triangles.
  std::string yaml = squashed("    remesh: {quality: 0.5, goal: 0.6}\n");
  const std::string cells = "cells: [4, 4, 4]";
  yaml.replace(yaml.find(cells), cells.size(), "cells: [1, 1, 1]");
  Run run(yaml);
  int exchanges = 0;
  for (int i = 0; i < 28; ++i) exchanges += run.step();
  CHECK(exchanges <= 2);
  CHECK(run.warnings.size() < 6);
  CHECK_THAT(first_text(run.warnings, WarningKind::not_remeshed), Catch::Contains("object 'block' at t = "));
}

TEST_CASE("two objects are exchanged independently", "[remesh]") {
  std::string yaml = squashed(anew);
  // A second block beside the first, which is higher and so squashed more.
  const std::string bottom = "  - name: bottom\n";
  yaml.insert(yaml.find(bottom), "  - name: pillar\n    shape: {type: box, size: [0.01, 0.02, 0.01], cells: [3, 5, 3]}\n    place: {translate: [0.022, 0, 0]}\n" + anew +
                                     "    energies: [{type: von_mises, young: 100 MPa, poisson: 0.3, density: 1000, yield_stress: 1 MPa, hardening: 1 MPa}]\n");
  Run run(yaml);
  std::set<int> bodies;
  for (int i = 0; i < 28; ++i) {
    const std::vector<Tet> block = run.body(0).tets;
    const int pillar = run.body(1).vertex_count;
    if (!run.step()) continue;
    for (const NewElements& e : run.last) bodies.insert(e.body);
    if (run.last.size() == 1 && run.last[0].body == 0) CHECK(run.body(1).vertex_count == pillar);
    if (run.last.size() == 1 && run.last[0].body == 1) CHECK(run.body(0).tets == block);
  }
  CHECK(bodies == std::set<int>{0, 1});
}

TEST_CASE("objects that cannot be remeshed are refused with source location and remedy", "[remesh]") {
  const std::string remesh = "    remesh: {}\n";
  const auto message = [](const std::string& yaml) -> std::string {
    try {
      Simulation simulation(loaded(yaml));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto replaced = [&](const std::string& part, const std::string& by) {
    std::string yaml = squashed(remesh);
    const size_t at = yaml.find(part);
    REQUIRE(at != yaml.npos);
    return yaml.replace(at, part.size(), by);
  };
  CHECK(message(squashed(remesh)) == "");
  struct Case {
    std::string yaml, told;
  };
  const std::string energies = "    energies: [{type: von_mises, young: 100 MPa, poisson: 0.3, density: 1000, yield_stress: 1 MPa, hardening: 1 MPa}]\n";
  const std::string elastic = "    energies: [{type: neo_hookean, young: 100 MPa, density: 1000}]\n";
  const std::vector<Case> cases = {
      {replaced(energies, elastic), "neo_hookean does not flow"},
      {replaced(energies, energies + "    elements: composite\n"), "its elements are not linear"},
      {replaced(energies, energies + "    elements: patches\n"), "its elements are not linear"},
      {replaced(energies, energies + "    surface: {edge_length: 1 mm}\n"), "its contact surface is refined"},
      {replaced(energies, energies + "    motion: [fixed]\n"), "vertices inside of 'block'"},
      {replaced(energies, energies + "    motion: [{type: fixed, along: [0, 0, 1]}]\n"), "vertices inside of 'block'"},
      {replaced(energies, energies + "    motion: [{type: fixed, select: {type: indices, vertices: [0, 1]}}]\n"), "selection indices: object 'block' is remeshed"},
      {replaced(energies, energies + "    attach: [{to: bottom, select: {type: face, direction: [0, -1, 0]}, within: 1 mm}]\n"), "attached to another object"},
      {replaced(energies, "    body: {type: affine, density: 1000}\n"), "affine body"},
      {squashed(remesh) + "interactions: [{type: spring, from: {object: block, select: {type: face, direction: [1, 0, 0]}}, to: {object: bottom}, stiffness: 1 N/m}]\n",
       "the interaction spring acts on it"},
      {squashed(remesh) + "output: {gradients: [{as: e, key: objects.block.energies.0.young}]}\n", "output.gradients follow one mesh"},
      {squashed("    remesh: {quality: 0.3, goal: 0.2}\n"), "is not above `quality`"},
      {squashed("    remesh: {quality: 2}\n"), "quality"},
  };
  for (const Case& c : cases) {
    const std::string told = message(c.yaml);
    CAPTURE(c.told, told);
    CHECK(contains(told, c.told));
    CHECK(contains(told, "scene.yaml:"));
  }
}
