// All solvers on all cases, one after the other and again, so that a slow minute of the machine does not
// count against one of them.
#pragma once

#include <functional>

#include "framework/compare/compare_config.hpp"
#include "framework/compare/reference.hpp"

namespace tack {

// One solver with one tolerance on one case with one time step.
struct CompareRow {
  std::string problem, solver;
  double tolerance = 0, time_step = 0;                           // m/s, s
  double wall_seconds = 0, wall_spread = 0, cpu_seconds = 0;     // median; largest - smallest; median
  double wall_least = 0, wall_most = 0;                          // of the repetitions
  long iterations = 0, evaluations = 0, linear_solves = 0;
  std::string status;
  bool converged = false;
  // "same" solution as the reference's, "equal" in potential, "another"; of a run that ended elsewhere but comes closer with
  // smaller tolerances "inaccurate"; "": not known.
  std::string branch;
  // Of a run, from the reference's end; of a single step, from the minimum that the solver came to, refined
  // as far as the reference. Like this, solvers that come to another minimum are judged fairly.
  double error_rms = 0, error_max = 0, relative_error = 0;       // m, m, of the size; NaN: none
  double floor = 0;  // RMS [m]: what the references tell apart, smaller errors are noise (reference.hpp); NaN: not known
  double size = 0;   // of what moves [m]
  double energy_gap = 0;                                         // J, over the reference's
  std::vector<std::pair<std::string, double>> probe_errors;
  int intersections = 0;
  double penetration = 0, crossing_pairs = 0;  // TrialResult
  bool single_step = false;
  bool noise() const { return error_rms <= floor; }
  double known_error() const { return noise() ? floor : error_rms; }  // at most
  bool solved() const { return converged && (single_step || branch != "another"); }
};

// Runs that ended away from the reference are on another branch, or merely not accurate: those whose solver comes to the
// reference with a smaller tolerance, or to half the distance.
void tell_branches_apart(std::vector<CompareRow>& rows);

// A task is a problem with a tolerance and a time step.
inline bool same_task(const CompareRow& a, const CompareRow& b) {
  return a.problem == b.problem && a.tolerance == b.tolerance && a.time_step == b.time_step;
}
// Whether a is as fast as b, or slower by no more than repetitions differ.
inline bool as_fast(const CompareRow& a, const CompareRow& b) { return a.wall_least <= b.wall_most; }

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
  std::string history_of;  // the problem
  std::vector<IterationHistory> histories;
};

// `tell` gets a line for each thing that was done.
Comparison compare(const CompareConfig& config, const std::vector<CompareCase>& cases,
                   const std::function<void(const std::string&)>& tell);

// The cases of a file, each built once. Throws InputError for what does not fit, before anything is measured.
std::vector<CompareCase> cases_of(const CompareConfig& config);

}  // namespace tack
