// A scene of experiments/hard, and the outcome of its run with one solver.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tack {

struct HardCase {
  std::filesystem::path scene;
  std::string name, about;
  // Expected exit code: 0, or that of a line `# Ends with CODE: TEXT` in the scene.
  int exit_code = 0;
  std::string diagnosis;  // TEXT, which the output must contain
};

struct HardSolver {
  std::string name;
  std::vector<std::string> overrides;  // arguments of `--set`
};

struct HardOutcome {
  int exit_code = -1;  // -1: ended by a signal, or not within a minute
  std::string output;  // printed by the program
  bool ran = false;    // there are results; the following members are from them
  std::string error;   // cause of the end
  int iterations = 0, gains = 0, intersections = 0, inverted = 0;
  std::vector<std::string> missed_expectations;
  double energy_loss = 0, energy_gain = 0, force_residual = 0;  // as in StepsBalance
};

// Returns the scenes of experiments/hard, ordered by name.
std::vector<HardCase> hard_cases();
// Reads a scene. Throws std::runtime_error if it has no `about`, or another name than its file.
HardCase read_hard_case(const std::filesystem::path& scene);

// Returns the solvers of the page, the default first.
const std::vector<HardSolver>& hard_solvers();
// Returns a solver: the name of a minimizer, or a key of the solver with its value,
// "projection=absolute".
HardSolver hard_solver(const std::string& text);

// Runs a case with a solver. plugins: absolute paths, loaded before the scene is read.
HardOutcome run_hard_case(const HardCase& c, const HardSolver& solver,
                          const std::vector<std::string>& plugins = {});

// Returns the fault of an outcome; "" if the case ended as its scene expects.
std::string fault(const HardCase& c, const HardOutcome& outcome);

}  // namespace tack
