// steps.csv: one row per accepted step. Columns: step, time [s], step_size [s], halvings,
// newton_iterations, linear_solves, linear_iterations, line_search_evaluations, contacts, candidates, min_distance,
// min_gap (of different objects) [m], energy_<term> [J] for each term, the balance of energy [J] (stepping/energy_balance.hpp): work_loads,
// work_script, work_rim, work_healing, dissipated_friction, dissipated_adhesion, dissipated_plastic, dissipated_damping, dissipated_areas,
// dissipated_numerics (and, between those of one kind, what else terms publish: core/records.hpp), then residual,
// unbalanced_force [N], tolerated_force [N], converged (0 or 1), lag_iterations, friction_residual, wall_seconds, seconds_<phase> for each phase.
#pragma once

#include <filesystem>
#include <optional>

#include "framework/output/csv.hpp"
#include "framework/stepping/step_report.hpp"

namespace tack {

// The energies and flows of the first report fix the columns; later reports must name the same
// (std::logic_error otherwise). Throws InputError when the file cannot be written.
class StepsCsv {
 public:
  // The file appears with its first row.
  explicit StepsCsv(std::filesystem::path path) : path_(std::move(path)) {}

  // Continues a file written before with its rows up to `last_time` [s]; a missing file is an empty
  // one. The first report must then fit its columns (InputError otherwise).
  static StepsCsv continued(std::filesystem::path path, double last_time);

  void add(const StepReport& report);

 private:
  void open(const StepReport& first);

  std::filesystem::path path_;
  CsvTable before_;
  std::vector<std::string> terms_;
  std::optional<CsvFile> file_;
};

}  // namespace tack
