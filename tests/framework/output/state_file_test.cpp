// State files: exact; refused with a reason if incomplete; and a step from one has the bits of the
// run.
#include "framework/output/state_file.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "framework/experiment/built_experiment.hpp"
#include "framework/experiment/stored_experiment.hpp"
#include "geometry/checksum.hpp"
#include "geometry/errors.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// A sliding adhesive block with friction, which a motion releases in the middle of the run.
const std::string scene_text = R"(
time: {step: 0.01 s, duration: 0.2 s, integrator: bdf2}
gravity: [0, -9.81, 0]
objects:
  - {name: floor, shape: {type: box, size: [1, 0.2, 1]}, place: {translate: [0, -0.1, 0]}, motion: [fixed]}
  - name: block
    shape: {type: box, size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}
    place: {translate: [0, 0.1006, 0]}
    velocity: [0.5, 0, 0.1]
    energies: [{type: neo_hookean, young: 0.2 MPa, poisson: 0.3, density: 1000}]
    motion:
      - {type: translate, velocity: [0.5, 0, 0], until: 0.04 s, select: {type: face, direction: [-1, 0, 0]}}
contact:
  distance: 1 mm
  friction: {mu: 0.3}
  lagging: {iterations: 3, until: 1e-4}
  pairs: [{between: [block, floor], adhesion: {type: fang, critical_strain: 0.001}}]
)";

void check_same(const State& a, const State& b) {
  CHECK(a.time == b.time);
  CHECK(a.step == b.step);
  CHECK(a.motion_active == b.motion_active);
  CHECK(a.step_size.h_next == b.step_size.h_next);
  CHECK(a.h_before == b.h_before);
  CHECK(a.contact_time_before == b.contact_time_before);
  CHECK((a.x == b.x && a.v == b.v && a.a == b.a));
  CHECK((a.x_motion_start == b.x_motion_start && a.x_before == b.x_before && a.v_before == b.v_before));
  CHECK((a.contact == b.contact && a.contact_before == b.contact_before));
  CHECK(a.history == b.history);
  CHECK(a.energy.open == b.energy.open);
  CHECK((a.energy.kinetic == b.energy.kinetic && a.energy.gravity == b.energy.gravity));
  CHECK((a.energy.elastic == b.energy.elastic && a.energy.contact == b.energy.contact));
  CHECK(a.energy.dissipated == b.energy.dissipated);
  CHECK((a.energy.gradient == b.energy.gradient && a.energy.numerical_gain == b.energy.numerical_gain));
  CHECK((a.energy.numerical_gain_low == b.energy.numerical_gain_low && a.energy.reference_energy == b.energy.reference_energy));
}

}  // namespace

TEST_CASE("a step from a problem's file has the bits of the run", "[state_file]") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.problem";
  TestRun run(scene_text);
  Simulation& simulation = run.simulation;
  for (int step = 0; step < 8; ++step) {  // the motion lets go at step 4
    INFO("step " << step);
    simulation.start_from(simulation.state());
    StateFile file = state_file_of(StateFile::Kind::problem, simulation.experiment());
    file.state = simulation.state();
    write_state_file(path, file);
    const StateFile read = read_state_file(path, StateFile::Kind::problem);
    check_same(read.state, file.state);
    Simulation again(experiment_of(read, path));
    again.start_from(read.state);
    simulation.step();
    again.step();
    check_same(again.state(), simulation.state());
  }
}

TEST_CASE("a file of an old program without contact history and energy balance is read", "[state_file]") {
  const State read = read_state_file(TACK_TEST_DATA "/problems/sliding.problem", StateFile::Kind::problem).state;
  CHECK((read.contact.size() == 0 && !read.energy.open));
  CHECK((read.x.size() > 0 && read.v.size() == read.x.size()));
}

TEST_CASE("a problem contains the meshes that its scene reads from files", "[state_file]") {
  const TemporaryFolder folder;
  const fs::path mesh = folder.path() / "tets.msh", path = folder.path() / "a.problem";
  fs::copy_file(TACK_TEST_DATA "/meshes/two_tets_41_ascii.msh", mesh);
  TestScene scene("objects:\n  - {name: obstacle, shape: {type: file, path: " + mesh.string() +
                  "}, motion: [fixed]}\n"
                  "  - {name: block, shape: {type: box, size: [1, 1, 1]}, energies: [{type: neo_hookean, young: 1e5}]}");
  StateFile file = state_file_of(StateFile::Kind::problem, scene.config);
  file.state = scene.world->start;
  write_state_file(path, file);
  fs::remove(mesh);
  const StateFile read = read_state_file(path, StateFile::Kind::problem);
  const BuiltExperiment again(experiment_of(read, path));
  const World* const world = &again.world();
  CHECK(world->rest == scene.world->rest);
  CHECK(world->bodies[0].tets == scene.world->bodies[0].tets);
  CHECK(world->bodies[0].tags == scene.world->bodies[0].tags);
  check_size(read, world->rest.size() / 3, path);
  CHECK_THROWS_WITH(check_size(read, 3, "a"), Catch::Contains("a: its state has"));
}

TEST_CASE("other files are refused with the reason", "[state_file]") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.problem";
  const auto error_of = [&](StateFile::Kind kind) -> std::string {
    try {
      read_state_file(path, kind);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(contains(error_of(StateFile::Kind::problem), "a.problem: cannot read this file"));
  write_file(path, "name: a scene\n");
  CHECK(contains(error_of(StateFile::Kind::problem), "is not a complete file of `tack run --dump-problem`"));

  TestScene scene(scene_text);
  StateFile file = state_file_of(StateFile::Kind::checkpoint, scene.config);
  file.state = scene.world->start;
  write_state_file(path, file);
  CHECK(error_of(StateFile::Kind::checkpoint) == "");
  CHECK(contains(error_of(StateFile::Kind::problem), "is a checkpoint, and a problem is needed"));
  const std::string whole = file_text(path);
  write_file(path, whole.substr(0, whole.size() / 2));
  CHECK(contains(error_of(StateFile::Kind::checkpoint), "is damaged or cut short (its checksum"));

  write_file(path, "tack state 99" + whole.substr(whole.find(" crc32")));
  CHECK(contains(error_of(StateFile::Kind::checkpoint), "has version 99 of the format, and this program reads version 2"));
  auto json = nlohmann::json::from_cbor(whole.substr(whole.find('\n') + 1));
  const auto write = [&] {  // with a checksum that is right
    std::string bytes;
    nlohmann::json::to_cbor(json, bytes);
    write_file(path, fmt::format("tack state 2 crc32 {:08x} bytes {}\n", crc32_of(bytes.data(), bytes.size()), bytes.size()) + bytes);
  };
  write();
  CHECK(error_of(StateFile::Kind::checkpoint) == "");
  json["warnings"] = {{"step 1: halved", "halved step", 3}};  // of a version with other kinds
  write();
  const std::vector<WarningCount> warnings = read_state_file(path, StateFile::Kind::checkpoint).warnings;
  REQUIRE(warnings.size() == 1);
  CHECK(only_text({warnings[0].first}, WarningKind::unspecified) == "step 1: halved");
  CHECK(warnings[0].times == 3);
  json["state"].erase("x");
  write();
  CHECK(contains(error_of(StateFile::Kind::checkpoint), "is damaged"));
}

TEST_CASE("a damaged bit of a stored state is detected", "[state_file]") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.problem";
  TestScene scene(scene_text);
  StateFile file = state_file_of(StateFile::Kind::problem, scene.config);
  file.state = scene.world->start;
  write_state_file(path, file);
  const std::string whole = file_text(path);
  int refused = 0, damages = 0;
  for (size_t at = 0; at < whole.size(); at += 13) {
    std::string damaged = whole;
    damaged[at] ^= static_cast<char>(1 << at % 8);
    write_file(path, damaged);
    ++damages;
    try {
      read_state_file(path, StateFile::Kind::problem);
    } catch (const InputError&) {
      ++refused;
    }
  }
  CHECK(refused == damages);
}
