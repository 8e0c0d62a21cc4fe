// `start`: objects begin in the state of an earlier run, with their history variables.
#include "framework/experiment/read_initial_state.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>

#include "framework/experiment/stored_experiment.hpp"
#include "framework/output/checkpoints.hpp"
#include "framework/run/recorded_run.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/silence.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

constexpr const char* floor_object = "  - {name: floor, shape: {type: box, size: [0.5, 0.1, 0.5]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}\n";
constexpr const char* lump = "  - {name: lump, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [0, 0.052, 0]},\n"
                             "     energies: [{type: von_mises, young: 100 kPa, density: 1000, yield_stress: 1.5 kPa}]}\n";
constexpr const char* stone = "  - {name: stone, groups: [stiff], shape: {type: box, size: [0.06, 0.06, 0.06]}, place: {translate: [0, 0.16, 0], axis: [1, 0, 1], angle: 20 deg},\n"
                              "     body: {type: affine, density: 3000}, velocity: [0, -0.5, 0]}\n";

std::string scene_of(const std::string& objects, double duration, const std::string& more = "") {
  return fmt::format("time: {{step: 10 ms, duration: {}}}\ngravity: [0, -9.81, 0]\nsolver: {{tolerance: 0.1 mm/s}}\nobjects:\n{}"
                     "contact: {{distance: 2 mm, friction: {{mu: 0.3}}}}\noutput: {{checkpoint_interval: 0.1 s, frames: false}}\n{}",
                     duration, objects, more);
}

const std::string all = std::string(floor_object) + lump + stone;

std::string from(const fs::path& folder, const std::string& more = "") { return fmt::format("start: {{from: {}{}}}\n", folder.string(), more); }

RunSummary record(const std::string& yaml, const fs::path& folder, std::vector<std::string> dump = {}) {
  std::ostringstream printed;
  RunSettings settings;
  settings.output = folder.string();
  settings.dump_problems = std::move(dump);
  RecordedRun run(parse_experiment("name: settled\n" + yaml, "settled.yaml"), settings, {}, printed, {});
  const RunSummary summary = run.execute();
  INFO(printed.str());
  REQUIRE(summary.status == RunStatus::done);
  return summary;
}

State state_at(const fs::path& folder, int step) {
  return read_state_file(folder / "checkpoints" / fmt::format("step_{:08}.checkpoint", step), StateFile::Kind::checkpoint).state;
}

// A run of 0.2 s, whose stone has hit the lump by then.
struct Settled {
  Settled() { record(scene_of(all, 0.2), run); }
  TemporaryFolder folder;
  fs::path run = folder.path() / "run";
  State state() const { return state_at(run, 20); }
};

}  // namespace

TEST_CASE("a scene starts where an earlier run of it ended", "[start]") {
  const Settled settled;
  const State end = settled.state();
  REQUIRE(end.history.at("lump/energies/0/plastic_strain").values.size() > 0);
  TestRun more(scene_of(all, 0.3, from(settled.run)));
  CHECK(more.world->start_notes.at(0) == fmt::format("3 of 3 objects start as they were in {} (t = 0.2 s)",
                                                     (settled.run / "checkpoints/step_00000020.checkpoint").string()));
  CHECK(more.state().time == 0);
  CHECK((more.state().x - end.x).lpNorm<Eigen::Infinity>() < 1e-15);
  CHECK((more.state().v - end.v).lpNorm<Eigen::Infinity>() < 1e-13);
  CHECK(more.state().history.at("lump/energies/0/plastic_strain") == end.history.at("lump/energies/0/plastic_strain"));
  record(scene_of(all, 0.3), settled.folder.path() / "whole");
  for (int i = 0; i < 10; ++i) more.step();
  CHECK((more.state().x - state_at(settled.folder.path() / "whole", 30).x).lpNorm<Eigen::Infinity>() < 2e-6);
}

TEST_CASE("subdivided objects and history on patches start unchanged if the scene is equal", "[start]") {
  const auto with = [](const std::string& elements) {
    std::string objects = all;
    objects.insert(objects.find("cells: [2, 2, 2]},") + 18, " elements: " + elements + ",");
    return objects;
  };
  for (const std::string elements : {"composite", "patches"}) {
    INFO(elements);
    const TemporaryFolder folder;
    const fs::path run = folder.path() / "run";
    record(scene_of(with(elements), 0.1), run);
    const State end = state_at(run, 10);
    TestRun more(scene_of(with(elements), 0.1, from(run)));
    CHECK((more.state().x - end.x).lpNorm<Eigen::Infinity>() < 1e-15);
    CHECK(more.state().history.at("lump/energies/0/plastic_strain") == end.history.at("lump/energies/0/plastic_strain"));
    CHECK(more.step().step == 1);
    CHECK_THROWS_WITH(TestScene(scene_of(all, 0.1, from(run))),
                      Contains("object 'lump'") && Contains(elements == "composite" ? "had another mesh" : "energies or elements differ now"));
  }
}

TEST_CASE("some of the objects start as they were, at rest, among others", "[start]") {
  const Settled settled;
  const State end = settled.state();
  const std::string other = "  - {name: weight, shape: {type: box, size: [0.02, 0.02, 0.02]}, place: {translate: [0.2, 0.05, 0]}, body: {type: affine, density: 1000}}\n";
  TestScene scene(scene_of(other + stone + floor_object, 0.1, from(settled.run, ", objects: [stiff], velocities: false")));
  const int first = scene.world->bodies[scene.world->body_index("stone")].first_vertex;
  const int before = 8 + 27;  // of the floor and the lump there
  REQUIRE(first == 8);
  for (int v = 0; v < 8; ++v) CHECK((vertex(scene.world->start.x, first + v) - vertex(end.x, before + v)).norm() < 1e-15);
  CHECK(vertex(end.v, before).norm() > 0.001);
  CHECK(scene.world->start.v.isZero());
  CHECK((vertex(scene.world->start.x, 0) - vertex(scene.world->rest, 0)).norm() < 1e-15);
  CHECK_THAT(scene.world->start_notes.at(0), Contains("1 of 3 objects"));
  CHECK(scene.world->start.history.empty());
}

TEST_CASE("it is the start that must not intersect, not the shapes at rest", "[start]") {
  const Settled settled;
  // At rest the stone is inside of this; it has left when the run ends, and is where the other is.
  const auto block_at = [&](double height) {
    return fmt::format("  - {{name: block, shape: {{type: box, size: [0.04, 0.01, 0.04]}}, place: {{translate: [0, {}, 0]}}, body: {{type: affine, density: 1000}}}}\n", height);
  };
  CHECK_THROWS_WITH(TestScene(scene_of(all + block_at(0.185), 0.1)), Contains("the start intersects"));
  CHECK_NOTHROW(TestScene(scene_of(all + block_at(0.185), 0.1, from(settled.run))));
  const int stone_vertex = 8 + 27;
  const Vec3 now = vertex(settled.state().x, stone_vertex);
  CHECK_THROWS_WITH(TestScene(scene_of(all + fmt::format("  - {{name: block, shape: {{type: box, size: [0.01, 0.01, 0.01]}}, place: {{translate: [{}, {}, {}]}}, body: {{type: affine, density: 1000}}}}\n",
                                                         now.x(), now.y(), now.z()), 0.1, from(settled.run))),
                    Contains("the start intersects"));
}

TEST_CASE("history variables of pairs are restored by their keys", "[start]") {
  const Settled settled;
  const fs::path path = settled.run / "checkpoints/step_00000020.checkpoint";
  StateFile file = read_state_file(path, StateFile::Kind::checkpoint);
  // Vertices of the objects there: floor (0 to 7), lump (8 to 34), stone (35 to 42).
  file.state.history["contact/memory"] = {2, {1, 2, 3, 4, 5, 6, 7, 8}, {{3, 2}, {9, 0}, {36, 0}, {36, 1}}};
  write_state_file(path, file);
  const std::string other = "  - {name: weight, shape: {type: box, size: [0.02, 0.02, 0.02]}, place: {translate: [0.2, 0.05, 0]}, body: {type: affine, density: 1000}}\n";
  // Here: weight 0 to 7, stone 8 to 15, floor 16 to 23.
  const TestScene scene(scene_of(other + stone + floor_object, 0.1, from(settled.run, ", objects: [stone, floor]")));
  CHECK(scene.world->start.history.at("contact/memory") == HistoryArray{2, {5, 6, 1, 2}, {{9, 2}, {19, 1}}});
  const TestScene alone(scene_of(other + stone + floor_object, 0.1, from(settled.run, ", objects: [stone]")));
  CHECK(alone.world->start.history.empty());
  file.state.history["contact/memory"].keys[3] = {36, 7};
  write_state_file(path, file);
  CHECK_THROWS_WITH(TestScene(scene_of(all, 0.1, from(settled.run))), Contains("its history 'contact/memory' does not fit its objects"));
}

TEST_CASE("the side of an adhesive pair that integrates comes along", "[start]") {
  const auto sticky = [](std::string scene) {
    return scene.replace(scene.find("friction: {mu: 0.3}"), 19, "pairs: [{between: [stone, floor], adhesion: {type: fang, peak_traction: 1 kPa}}]");
  };
  const TemporaryFolder folder;
  const fs::path run = folder.path() / "run", path = run / "checkpoints/step_00000010.checkpoint";
  record(sticky(scene_of(all, 0.1)), run);
  StateFile file = read_state_file(path, StateFile::Kind::checkpoint);
  CHECK(file.state.history.at("contact/integrating_sides").keys.empty());  // the stone, which is finer
  file.state.history["contact/integrating_sides"] = {1, {1}, {{0, 2}}};    // as if it were the floor
  write_state_file(path, file);
  TestRun more(sticky(scene_of(stone + std::string(floor_object) + lump, 0.1, from(run))));
  more.step();
  // They are far from each other, so no side is chosen again.
  CHECK(more.state().history.at("contact/integrating_sides") == HistoryArray{1, {1}, {{8, 0}}});
}

TEST_CASE("a state that does not fit is refused with the object and the remedy", "[start]") {
  const Settled settled;
  const auto refused = [&](const std::string& objects, const std::string& start, const std::string& why) {
    CHECK_THROWS_WITH(TestScene(scene_of(objects, 0.1, start)), Contains("test.yaml") && Contains(why));
  };
  std::string finer = all, weaker = all, soft = all;
  finer.replace(finer.find("cells: [2"), 8, "cells: [3");
  weaker.replace(weaker.find("1.5 kPa"), 7, "2.5 kPa");
  soft.replace(soft.find("body: {type: affine, density: 3000}"), 35, "energies: [{type: neo_hookean, young: 1 MPa, density: 1000}]");
  refused(finer, from(settled.run), "object 'lump' had another mesh in");
  refused(weaker, from(settled.run), "object 'lump' has history variables");
  refused(soft, from(settled.run), "object 'stone' had 4 vertices in");
  CHECK_NOTHROW(TestScene(scene_of(weaker, 0.1, from(settled.run, ", objects: [floor]"))));
  refused(all, from(settled.run, ", objects: [stones]"), "there is no object or group 'stones'; did you mean 'stone'?");
  const std::string another = "  - {name: cube, shape: {type: box, size: [0.06, 0.06, 0.06]}, place: {translate: [0, 1, 0]}, body: {type: affine, density: 1000}}\n";
  refused(all + another, from(settled.run, ", objects: [cube]"), "there is no object 'cube' in");
  refused(another, from(settled.run), "no object of the scene is in");
  refused(all, from(settled.folder.path() / "none"), "none");
  refused(all, from(settled.folder.path()), "there is no checkpoint in");
  refused(all, from(settled.run / "probes.csv"), "probes.csv");
  std::string pushed = scene_of(all, 0.1, from(settled.run));
  pushed.replace(pushed.find("distance: 2 mm"), 14, "distance: 2 mm, overclosure_adjustment: 1 mm");
  CHECK_THROWS_WITH(TestScene(pushed), Contains("contact.overclosure_adjustment"));

  StateFile former = read_state_file(settled.run / "checkpoints/step_00000020.checkpoint", StateFile::Kind::checkpoint);
  former.objects.clear();
  const fs::path path = settled.folder.path() / "former.checkpoint";
  write_state_file(path, former);
  refused(all, from(path), "was written by an earlier program");
}

TEST_CASE("a step of a run that started from another is stored with its start", "[start]") {
  const Settled settled;
  const fs::path run = settled.folder.path() / "next";
  const std::string block = "  - {name: block, shape: {type: box, size: [0.04, 0.01, 0.04]}, place: {translate: [0, 0.185, 0]}, body: {type: affine, density: 1000}}\n";
  record(scene_of(all + block, 0.2, from(settled.run)), run, {"step=3"});
  fs::remove_all(settled.run);
  const fs::path path = run / "problems/settled.step3.problem";
  const StateFile problem = read_state_file(path, StateFile::Kind::problem);
  Simulation again(experiment_of(problem, path.string()));
  again.start_from(problem.state);
  again.step();
  CHECK(again.state().step == 3);
}

TEST_CASE("a state that a material does not bear is refused", "[start]") {
  const TemporaryFolder folder;
  const auto bar = [](const std::string& material) {
    return "time: {step: 0.1 s, duration: 0.2 s, integrator: quasi_static}\nobjects:\n  - name: bar\n    shape: {type: box, size: [0.1, 0.1, 0.1]}\n"
           "    energies: [{type: gent, shear_modulus: 1 kPa, j_m: " + material + "}]\n"
           "    motion:\n      - {type: fixed, select: {type: face, direction: [-1, 0, 0]}}\n"
           "      - {type: formula, x: 0.5 * t, along: [1, 0, 0], select: {type: face, direction: [1, 0, 0]}}\noutput: {checkpoint_interval: 0.1 s, frames: false}\n";
  };
  record(bar("50"), folder.path() / "run");  // to a stretch of 2
  CHECK_NOTHROW(TestScene(bar("50") + from(folder.path() / "run")));
  CHECK_THROWS_WITH(TestScene(bar("0.5") + from(folder.path() / "run")),
                    Contains("test.yaml") && Contains("of 'bar' would have I1 - 3 of ") && Contains("gent allows less than ") && Contains("`j_m`") && Contains("start.objects"));
}
