// A scene of experiments/hard, and how the program ends it with one solver.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tack {

struct HardCase {
  std::filesystem::path scene;
  std::string name, about;
  // It must end with: 0, or that of a line `# Ends with CODE: TEXT` in the scene.
  int exit_code = 0;
  std::string diagnosis;  // TEXT: part of what is told then
};

struct HardSolver {
  std::string name;
  std::vector<std::string> overrides;  // as `--set` takes them
};

struct HardOutcome {
  int exit_code = -1;  // -1: ended by a signal, or not within a minute
  std::string told;    // what was printed
  bool ran = false;    // there are results, and the rest is from them
  std::string error;   // what ended it
  int iterations = 0, gains = 0, intersections = 0, inverted = 0;
  std::vector<std::string> missed;  // expectations that do not hold
  // Energy that contact areas and integrator took, and made; of the largest in the run.
  double lost = 0, made = 0;
  // The largest force that nothing balances, over what is tolerated.
  double unbalanced = 0;
};

// The scenes of experiments/hard, by name.
std::vector<HardCase> hard_cases();
// Throws std::runtime_error where the scene has no `about` or another name than its file.
HardCase read_hard_case(const std::filesystem::path& scene);

// The default first.
const std::vector<HardSolver>& hard_solvers();

HardOutcome run_hard_case(const HardCase& c, const HardSolver& solver);

// What is wrong with how a case ended; "" if nothing is: it must end as its scene says.
std::string fault(const HardCase& c, const HardOutcome& outcome);

}  // namespace tack
