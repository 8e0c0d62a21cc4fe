// The cases of a batch, each with its whole scene: all are read and built once before any of them runs.
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
  std::string digest;                         // of the scene, the files that it reads and the program
  double duration = 0;                        // s, simulated
};

struct BatchPlan {
  std::string name, about;
  std::vector<std::string> columns;  // what varies; `base` first if there are several
  std::vector<BatchStatistic> statistics;
  std::vector<BatchPlot> plots;
  std::map<std::string, std::string> units;  // of columns that have one, and the same in all cases: "Pa"
  std::vector<BatchCase> cases;
};

// Told after each case: how many are planned, of how many.
using PlanProgress = std::function<void(size_t done, size_t all)>;

// `program`: what identifies the program (program_digest()). Throws InputError with everything that is wrong with any case.
BatchPlan plan_of(const BatchConfig& config, const std::string& program, const PlanProgress& progress = {});

// Builds the world of a case, as a run does first: meshes, pairs, probes, the start. Throws InputError.
void check_case(const BatchPlan& plan, const BatchCase& one);

// Of a case's values by the names of what varies, "young=1e5,translate=0,0.05,0"; safe in shells and file systems.
std::string case_name(const std::vector<std::pair<std::string, std::string>>& parts);

}  // namespace tack
