// steps.csv: one row per accepted step. Columns:
//    step, time [s], step_size [s], halvings
//    newton_iterations, linear_solves, linear_iterations, line_search_evaluations
//    contacts, candidates, min_distance [m], min_gap (of different objects) [m]
//    energy_<term> [J] for each term
//    energy balance [J] (stepping/energy_balance.hpp): work_loads, work_script, work_rim,
//      work_healing, dissipated_friction, dissipated_adhesion, dissipated_plastic,
//      dissipated_damping, dissipated_areas, dissipated_numerics; flows that terms publish
//      (core/records.hpp) stand among those of their kind
//    residual, unbalanced_force [N], tolerated_force [N], converged (0 or 1)
//    lag_iterations, friction_residual
//    wall_seconds, seconds_<phase> for each phase
//    rejected_<reason> for each (stepping/rejection.hpp): rejected tries of the step
//    step_error, repeats, if steps are adaptive; step metrics of the stepper (core/step_metric.hpp)
#pragma once

#include <filesystem>
#include <optional>

#include "framework/output/csv.hpp"
#include "framework/stepping/step_report.hpp"

namespace tack {

// Energies and flows of the first report determine the columns; later reports must have the same
// names (std::logic_error). Throws InputError if the file cannot be written.
class StepsCsv {
 public:
  // The first row creates the file.
  explicit StepsCsv(std::filesystem::path path) : path_(std::move(path)) {}

  // Continues an existing file with its rows up to `last_time` [s]; a missing file counts as empty.
  // The first report must fit its columns (InputError).
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
