// The file of `tack compare`, typed: problems, solvers, tolerances, time steps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/field.hpp"

namespace tack {

struct SolverEntry {
  std::string name;
  Value solver;                            // overrides of the scene's solver block, as written
  Value stepper;                           // overrides of its time.stepper
  Value time;                              // overrides of the rest of its time
  std::optional<double> own_step() const;  // s: the step of `time`
  void fields(Fields& f);
};

// An experiment, solved from its initial state.
struct BaseEntry {
  std::string name;              // empty: that of the experiment
  std::string file;              // absolute path
  std::vector<std::string> set;  // "a.b=c"
  int steps = 0;                 // in its own time step; 0: to its end
  void fields(Fields& f);
};

struct CompareConfig {
  std::string name;
  std::string about;
  std::vector<std::string> plugins;  // absolute paths; loaded
  std::string base;                  // absolute path of an experiment; empty: none
  std::vector<std::string> set;      // "a.b=c", for the base
  std::vector<BaseEntry> bases;
  std::vector<std::string> problems;  // absolute paths
  std::vector<SolverEntry> solvers;
  std::vector<double> tolerances;  // m/s
  std::vector<double> time_steps;  // s; empty: that of the scene
  int steps = 0;                   // for the base; 0: to its end
  int repeat = 3;
  double reference_tolerance = 1e-10;         // m/s
  std::optional<double> reference_time_step;  // s
  // Largest error of a vertex of a result that counts as solved, relative to the size of what
  // moves. Unless given, error_limit_default, and none for runs whose time step is not the
  // reference's.
  std::optional<double> error_limit;
  static constexpr double error_limit_default = 1e-3;
  void fields(Fields& f);
};

// Reads a comparison file. Throws InputError with file, line and remedy.
CompareConfig load_comparison(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace tack
