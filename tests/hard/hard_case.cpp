#include "tests/hard/hard_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "tests/hard/steps_balance.hpp"
#include "tests/support/json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/silence.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

// Returns the remainder of a line that starts with `key`; "" if it does not.
std::string rest_of(const std::string& line, const std::string& key) {
  return line.rfind(key, 0) == 0 ? line.substr(key.size()) : "";
}

void read_results(const fs::path& results, HardOutcome& outcome) {
  const nlohmann::json summary = read_json(results / "summary.json");
  outcome.ran = true;
  outcome.error = summary["error"];
  outcome.iterations = summary["totals"]["newton_iterations"];
  outcome.gains = summary["energy"]["gains"];
  outcome.intersections = summary["intersections"];
  outcome.inverted = summary["inverted_tets"];
  for (const auto& e : summary["expect"])
    if (!e["pass"]) outcome.missed_expectations.push_back(e["name"].get<std::string>() + " " + e["text"].get<std::string>());
  if (!fs::exists(results / "steps.csv")) return;  // no step was finished
  const StepsBalance balance = steps_balance(results / "steps.csv");
  outcome.energy_loss = balance.energy_loss;
  outcome.energy_gain = balance.energy_gain;
  outcome.force_residual = balance.force_residual;
}

}  // namespace

HardCase read_hard_case(const fs::path& scene) {
  HardCase c{scene, scene.stem().string(), "", 0, ""};
  std::string name;
  std::ifstream in(scene);
  for (std::string line; std::getline(in, line);) {
    if (const std::string text = rest_of(line, "name: "); !text.empty()) name = text;
    if (const std::string text = rest_of(line, "about: "); !text.empty()) c.about = text;
    if (const std::string text = rest_of(line, "# Ends with "); !text.empty()) {
      c.exit_code = text.at(0) - '0';
      c.diagnosis = text.substr(text.find(": ") + 2);
    }
  }
  if (name != c.name || c.about.empty())
    throw std::runtime_error(fmt::format("{}: needs 'name: {}' and an 'about'", scene.string(), c.name));
  return c;
}

std::vector<HardCase> hard_cases() {
  std::vector<HardCase> cases;
  for (const auto& entry : fs::directory_iterator(TACK_SOURCE_DIR "/experiments/hard"))
    if (entry.path().extension() == ".yaml") cases.push_back(read_hard_case(entry.path()));
  std::sort(cases.begin(), cases.end(), [](const HardCase& a, const HardCase& b) { return a.name < b.name; });
  return cases;
}

const std::vector<HardSolver>& hard_solvers() {
  static const std::vector<HardSolver> solvers = {
      {"projected_newton", {}},
      {"projection: absolute", {"solver.projection=absolute"}},
      {"linear: cholmod", {"solver.linear=cholmod"}},
      {"newton_pcg", {"solver.type=newton_pcg"}},
      {"lbfgs", {"solver.type=lbfgs"}},
      {"ceres_trust_region", {"solver.type=ceres_trust_region"}},
  };
  return solvers;
}

HardSolver hard_solver(const std::string& text) {
  const std::string key = text.find('=') == std::string::npos ? "type=" + text : text;
  return {text, {"solver." + key}};
}

HardOutcome run_hard_case(const HardCase& c, const HardSolver& solver, const std::vector<std::string>& plugins) {
  const TemporaryFolder folder;
  Arguments arguments = {"run", c.scene.string(), "-q", "-o", "out", "--threads", "1"};
  for (const std::string& text : solver.overrides) arguments.insert(arguments.end(), {"--set", text});
  if (!plugins.empty()) arguments.insert(arguments.end(), {"--set", fmt::format("plugins=[\"{}\"]", fmt::join(plugins, "\", \""))});
  const ProgramResult result = run_tack(folder.path(), arguments);
  HardOutcome outcome;
  outcome.exit_code = result.exit_code;
  outcome.output = result.out + result.err;
  if (fs::exists(folder.path() / "out/summary.json")) read_results(folder.path() / "out", outcome);
  return outcome;
}

std::string fault(const HardCase& c, const HardOutcome& o) {
  if (o.intersections > 0 || o.inverted > 0)
    return fmt::format("left {} intersections and {} inverted tets", o.intersections, o.inverted);
  if (o.exit_code != c.exit_code) return fmt::format("ended with {} instead of {}", o.exit_code, c.exit_code);
  if (!contains(o.output, c.diagnosis)) return fmt::format("did not print '{}'", c.diagnosis);
  if (c.exit_code == 0 && !o.ran) return "left no results";
  if (c.exit_code == 0 && o.force_residual > 1 + 1e-9)
    return fmt::format("ended normally with {:.3g} times the tolerated force residual", o.force_residual);
  return "";
}

}  // namespace tack
