// The cases of a batch, each with its whole scene. All scenes are read and built once before any
// case runs.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "framework/batch/batch_config.hpp"

namespace tack {

struct BatchCase {
  std::string name;                           // also of its folder: "young=1e5,mu=0.2"
  std::string base;                           // name of the experiment
  std::map<std::string, std::string> values;  // by column; numbers with a unit in SI
  std::string scene;                          // resolved, as YAML
  // Checksum of the scene, the files that it reads and the program.
  std::string digest;
  double duration = 0;         // s, simulated
  bool may_end_early = false;  // with its protocols, before the duration
  bool checkpoints = false;    // the case writes checkpoints that keep the bits of a run
};

struct BatchPlan {
  std::string name, about;
  std::vector<std::string> columns;  // varied columns; `base` first if there are several
  std::vector<BatchStatistic> statistics;
  std::vector<BatchPlot> plots;
  // Units of the columns, "Pa"; only of columns with one unit in all cases.
  std::map<std::string, std::string> units;
  std::vector<BatchCase> cases;
  std::vector<std::string> warnings;
};

// Called after each planned case with the number of planned cases and the total.
using PlanProgress = std::function<void(size_t done, size_t all)>;

// Plans the cases of a batch. `program`: digest of the program (program_digest()). Throws one
// InputError with the errors of all cases.
BatchPlan plan_of(const BatchConfig& config, const std::string& program,
                  const PlanProgress& progress = {});

// Builds the world of a case, as a run does first: meshes, pairs, probes, initial state. Throws
// InputError.
void check_case(const BatchPlan& plan, const BatchCase& one);

// Returns the name of a case from its varied columns and values, "young=1e5,translate=0,0.05,0";
// safe in shells and file systems.
std::string case_name(const std::vector<std::pair<std::string, std::string>>& parts);

}  // namespace tack
