// Stored problems, solved by several solvers: each solve is a process of its own, so that a crash
// or a hang of one is a row of the table and ends no other.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tack {

struct SuiteSettings {
  std::vector<std::string> problems;  // files; their stems are the names of the problems
  std::vector<std::string> solvers;   // names or YAML maps
  std::vector<std::string> plugins;   // absolute paths
  // Factors of the tolerances of the problems: a solve for each.
  std::vector<double> tolerance_scales = {1};
  double cpu_limit = 0;  // of a solve, processor time of all its threads [s]
  int threads = 1;       // of a solve
  int jobs = 1;          // concurrent solves
};

/// How a solve ended.
enum class SuiteOutcome {
  solved,      // converged, nothing intersects, and the Newton direction confirms it
  inexact,     // reported convergence, but the Newton direction there is far above the tolerance
  intersects,  // the result intersects or has an inverted tetrahedron
  failed,      // ended without convergence
  time_limit,
  refused,  // the solver does not fit the problem
  crashed,
};
inline constexpr int suite_outcomes = 7;
/// Returns the name of the value, as in leaderboard.csv.
std::string_view to_string(SuiteOutcome outcome);

/// A result counts as solved up to this stopping norm of the clamped Newton direction, in
/// tolerances: projections of the Hessian differ, and so do their directions.
inline constexpr double judged_residual_max = 10;

/// One solve. Members are empty where the solve has no result; units as in StoredSolve.
struct SuiteRow {
  std::string problem, solver;
  double tolerance_scale = 1;
  SuiteOutcome outcome = SuiteOutcome::crashed;
  std::string status;  // in words
  std::optional<double> iterations, evaluations, linear_solves, seconds, wall_seconds;
  std::optional<double> residual, distance, energy_gap, error, judged_residual, intersections;
  std::string minimum;  // same, equal, another; empty: unknown

  bool solved() const { return outcome == SuiteOutcome::solved; }
};

/// A problem, as its first solve reports it.
struct SuiteProblem {
  std::string name, file, program;                               // program: version that stored it
  std::optional<double> unknowns, step_size, minimum_tolerance;  // -, s, m/s
  bool quasi_static = false;
};

struct SuiteResult {
  std::vector<SuiteProblem> problems;
  std::vector<SuiteRow> rows;  // by problem, tolerance and solver
};

/// Solves all problems with all solvers. program: the executable of tack. scratch: a folder for the
/// files of the solves. ended: called after each solve with the result so far. Ends early if an
/// interrupt is requested.
SuiteResult run_suite(const SuiteSettings& settings, const std::string& program,
                      const std::filesystem::path& scratch,
                      const std::function<void(const SuiteResult&, const SuiteRow&)>& ended);

/// Returns the problem files of files and folders, by name. Throws InputError for a path that does
/// not exist, a folder without problems, and two problems of one name.
std::vector<std::string> problem_files(const std::vector<std::string>& paths);

}  // namespace tack
