// A run from an embedding program: no command line, no exit codes.
#include "framework/run/recorded_run.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <sstream>

#include "framework/config/describe.hpp"
#include "tests/support/json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

LoadedExperiment tiny() { return parse_experiment(tiny_scene, "tiny.yaml"); }

}  // namespace

TEST_CASE("a run is recorded without the command line", "[run]") {
  const TemporaryFolder folder;
  RunSettings settings;
  settings.output = (folder.path() / "results").string();
  settings.steps = 2;
  std::ostringstream printed;
  Provenance provenance;
  provenance.build.version = "1.2.3";
  RecordedRun run(tiny(), settings, provenance, printed, {});
  const RunSummary& summary = run.execute();
  CHECK(summary.status == RunStatus::done);
  CHECK(summary.steps == 2);
  CHECK(contains(printed.str(), "done: 2 steps"));
  for (const char* file : {"scene.yaml", "steps.csv", "probes.csv", "summary.json", "log.txt"})
    CHECK(std::filesystem::exists(folder.path() / "results" / file));
  CHECK(contains(file_text(folder.path() / "results/summary.json"), "\"1.2.3\""));
}

TEST_CASE("warnings of a run are in its summary, also after a resume", "[run]") {
  const TemporaryFolder folder;
  std::string text;
  const auto recorded = [&](RunSettings settings) {
    settings.output = (folder.path() / "results").string();
    std::ostringstream printed;
    RecordedRun run(parse_experiment(text, "tiny.yaml"), settings, {}, printed, {});
    run.execute();
    return printed.str();
  };
  const auto lines_with = [](const std::string& printed, const std::string& part) {
    int lines = 0;
    for (size_t at = 0; (at = printed.find(part, at)) != printed.npos; ++at) ++lines;
    return lines;
  };
  // With so few iterations that the step of the impact is halved more than once. The speed at which
  // it is depends on the last bits, and so on the processor.
  std::string printed;
  for (const char* speed : {"0.8", "0.9", "2", "1", "1.8", "0.7"}) {
    text = tiny_scene_with("energies:", fmt::format("velocity: [0, -{}, 0]\n    energies:", speed));
    text += "output: {checkpoint_interval: 0.02 s}\nsolver: {type: projected_newton, max_iterations: 8}\n";
    printed = recorded({});
    if (contains(printed, "done: ") && lines_with(printed, "rolled back") > 1) break;
  }
  INFO(printed);
  const auto summary = read_json(folder.path() / "results/summary.json"), whole = summary["warnings"], energy = summary["energy"];
  const int lines = lines_with(printed, "warning: ");
  int counted = 0;
  for (const auto& w : whole) {
    CHECK(contains(printed, "warning: " + w["text"].get<std::string>()));
    CHECK(warning_kind_of(w["kind"].get<std::string>()));
    counted += w["times"].get<int>();
  }
  CHECK(counted == lines);
  CHECK(whole.size() > 0);
  CHECK(counted > static_cast<int>(whole.size()));  // a step was halved more than once
  CHECK(contains(printed, std::to_string(whole.size()) + " warning"));
  // At its end, of the impact.
  CHECK(whole.back()["kind"] == entry_of(WarningKind::energy_integration).key);
  CHECK(energy["causes"]["integrator"]["lost"].get<double>() > 0.03 * energy["at_play"].get<double>());
  RunSettings part;
  part.steps = summary["steps"].get<int>() - 2;  // past the first checkpoint, however many steps the impact was cut into
  recorded(part);
  part = {};
  part.resume = true;
  recorded(part);
  const auto resumed = read_json(folder.path() / "results/summary.json");
  CHECK(resumed["warnings"] == whole);
  CHECK(resumed["energy"] == energy);
}

TEST_CASE("a run leaves its specification as it is", "[run]") {
  Simulation simulation(tiny());
  const std::string before = to_yaml(fields_of(simulation.experiment()));
  simulation.start();
  simulation.step();
  CHECK(to_yaml(fields_of(simulation.experiment())) == before);
  CHECK(&simulation.solver() != simulation.experiment().solver.get());
}

TEST_CASE("a run that starts from a state has the bits of the run that reached it", "[run]") {
  Simulation whole(tiny()), second(tiny());
  whole.start();
  whole.step();
  const State middle = whole.state();
  whole.start_from(middle);
  second.start_from(middle);
  whole.step();
  second.step();
  CHECK(whole.state().time > middle.time);
  CHECK((whole.state().x == second.state().x && whole.state().v == second.state().v));
}

// The block adheres: energies of adhesion and of the overlap boundary belong to its group.
TEST_CASE("the summary of a run names the objects of each energy group", "[run]") {
  std::string text = tiny_scene_with("energies:", "velocity: [0, -1, 0]\n    energies:");
  const size_t objects = text.find("objects:\n") + std::string("objects:\n").size();
  text.insert(objects, "  - {name: afar, shape: {type: box, size: [1, 1, 1]}, place: {translate: [1000, 0, 0]}, body: {type: affine, density: 1000}}\n");
  const TemporaryFolder folder;
  RunSettings settings;
  settings.output = (folder.path() / "results").string();
  settings.steps = 3;
  std::ostringstream printed;
  RecordedRun run(parse_experiment(text, "tiny.yaml"), settings, {}, printed, {});
  run.execute();
  const auto summary = read_json(folder.path() / "results/summary.json");
  INFO(printed.str() << summary["energy"]);
  std::vector<std::string> named;
  for (const auto& group : summary["energy"]["groups"]) named.push_back(group["objects"].get<std::string>());
  CHECK(named == std::vector<std::string>{"'afar'", "'block'"});
}
