// One experiment from file to results.
#pragma once

#include <cstdio>
#include <string>

#include "framework/app/scene_options.hpp"

namespace tack {

struct ExperimentOptions {
  SceneOptions scene;
  std::string output;  // empty: results/<name>
  int steps = 0;    // 0: to the end
  int threads = 0;  // 0: all cores
  bool quiet = false, verbose = false;
  bool resume = false;                     // from the newest checkpoint of the results folder
  std::vector<std::string> dump_problems;  // "step=K", "hardest=N"
};

// Returns the exit code. Throws InputError before anything is written.
int run_experiment(const ExperimentOptions& options);

}  // namespace tack
