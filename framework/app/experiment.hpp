// One experiment from file to results.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace tack {

struct ExperimentOptions {
  std::string file;
  std::string output;  // empty: results/<name>
  std::vector<std::string> overrides;
  int steps = 0;    // 0: to the end
  int threads = 0;  // 0: all cores
  bool quiet = false, verbose = false;
};

// Returns the exit code. Throws InputError before anything is written.
int run_experiment(const ExperimentOptions& options);

}  // namespace tack
