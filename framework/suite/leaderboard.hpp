// The leaderboard of a suite of stored problems: leaderboard.csv, leaderboard.json, and the scores
// of the solvers.
//
// leaderboard.csv has a row per problem, tolerance and solver. Unknown values are empty. Columns:
// - problem, solver, tolerance_scale (factor of the problem's tolerances)
// - outcome: solved, inexact, intersects, failed, time limit, refused, crashed (SuiteOutcome)
// - status: in words
// - iterations, evaluations (of line searches), linear_solves
// - seconds (processor time of all threads), wall_seconds
// - residual: last stopping norm of the solver, in tolerances
// - judged_residual: stopping norm of the clamped Newton direction at the result, in tolerances
// - distance: largest distance of a vertex from the stored minimum, over the largest displacement
//   of a vertex in the step
// - error: as distance, from the minimum that the result leads to
// - minimum: which one that is: same, equal (of the same potential), another
// - energy_gap [J]: potential over that of the stored minimum
// - intersections: of the result, by exact predicates
#pragma once

#include <array>
#include <filesystem>

#include "framework/output/provenance.hpp"
#include "framework/suite/suite_run.hpp"

namespace tack {

/// Results of one solver over all problems and tolerances.
struct SolverScore {
  std::string solver;
  int tasks = 0;
  std::array<int, suite_outcomes> count = {};  // by outcome
  int other_minima = 0;                        // solved tasks that ended in another minimum
  // Mean processor time per task, in which a task that is not solved counts twice the limit
  // (PAR2) [s].
  double penalized_seconds = 0;

  int solved() const { return count[static_cast<size_t>(SuiteOutcome::solved)]; }
};
/// Returns the scores, the best first: by solved tasks, then by penalized seconds.
std::vector<SolverScore> scores_of(const std::vector<SuiteRow>& rows, double cpu_limit);

/// Returns the scores as a table in plain text, a line per solver.
std::string score_table(const std::vector<SolverScore>& scores);

void write_leaderboard_csv(const std::filesystem::path& path, const std::vector<SuiteRow>& rows);

/// Returns leaderboard.json: provenance, settings, problems and scores. wall_seconds: of the suite.
/// complete: false if it was interrupted.
std::string leaderboard_json(const SuiteSettings& settings, const SuiteResult& result,
                             const Provenance& provenance, double wall_seconds, bool complete);

}  // namespace tack
