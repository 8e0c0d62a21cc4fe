// Runs all solvers on all cases in turn and repeats the whole round, so that a slow minute of the
// machine does not count against one solver.
#pragma once

#include <functional>
#include <limits>

#include "framework/compare/compare_config.hpp"
#include "framework/compare/reference.hpp"

namespace tack {

// Result of one solver with one tolerance on one case with one time step.
struct CompareRow {
  std::string problem, solver;
  double tolerance = 0, time_step = 0;  // m/s, s
  // wall_seconds and cpu_seconds are medians; wall_spread is largest - smallest.
  double wall_seconds = 0, wall_spread = 0, cpu_seconds = 0;
  double wall_min = 0, wall_max = 0;  // over the repetitions
  long iterations = 0, evaluations = 0, linear_solves = 0;
  std::string status;
  bool converged = false;
  // Solution that the solver found, relative to the reference:
  // - "same": the reference's solution
  // - "equal": another point of the same potential
  // - "another": another solution
  // - "inaccurate": of a run that ends elsewhere, but comes closer with smaller tolerances
  // - "": unknown
  std::string branch;
  // Distance of a run from the end of the reference; of a single step from the minimum that the
  // solver found, refined as far as the reference, so that solvers that find another minimum are
  // judged fairly.
  double error_rms = 0, error_max = 0, relative_error = 0;  // m, m, of the size; NaN: unknown
  // RMS [m]: the distance of the two references, below which errors are noise (reference.hpp); NaN:
  // unknown.
  double floor = 0;
  double size = 0;  // of the moving objects [m]
  // Largest relative_error of a result that counts as solved.
  double error_limit = std::numeric_limits<double>::infinity();
  double energy_gap = 0;  // J, over the reference's
  std::vector<std::pair<std::string, double>> probe_errors;
  int intersections = 0;
  double penetration = 0, crossing_pairs = 0;  // TrialResult
  bool single_step = false;
  bool below_floor() const { return error_rms <= floor; }
  double known_error() const { return below_floor() ? floor : error_rms; }  // upper bound
  bool ended_elsewhere() const { return !single_step && branch == "another"; }
  // Returns true for a result that converged, but too far from its solution.
  bool inaccurate() const {
    return converged && !ended_elsewhere() && relative_error > error_limit;
  }
  bool solved() const { return converged && !ended_elsewhere() && !inaccurate(); }
};

// Marks runs that ended away from the reference as "another" or "inaccurate". Inaccurate are runs
// whose solver reaches the reference, or halves the distance to it, with a smaller tolerance.
void classify_branches(std::vector<CompareRow>& rows);

// A task is a problem with a tolerance and a time step.
inline bool same_task(const CompareRow& a, const CompareRow& b) {
  return a.problem == b.problem && a.tolerance == b.tolerance && a.time_step == b.time_step;
}
// Returns true if a is as fast as b, up to the spread of the repetitions.
inline bool as_fast(const CompareRow& a, const CompareRow& b) { return a.wall_min <= b.wall_max; }

struct ReferenceRow {
  std::string problem;
  double time_step = 0, tolerance = 0, disagreement = 0, floor = 0, size = 0;
  bool other_branch = false, quasi_static = false;
  int unknowns = 0;
  std::string status;
};

struct IterationHistory {
  std::string solver;
  double tolerance = 0;
  std::vector<Iteration> iterations;
};

struct Comparison {
  std::vector<ReferenceRow> references;
  std::vector<CompareRow> rows;
  std::string history_of;  // name of the problem
  std::vector<IterationHistory> histories;
};

// Compares all solvers. `progress` is called with a line for each finished run.
Comparison compare(const CompareConfig& config, const std::vector<CompareCase>& cases,
                   const std::function<void(const std::string&)>& progress);

// Builds each case of a file once. Throws InputError for settings that do not fit, before any
// measurement.
std::vector<CompareCase> cases_of(const CompareConfig& config);

}  // namespace tack
