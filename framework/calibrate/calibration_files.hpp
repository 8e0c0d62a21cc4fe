// The files of a calibration.
//
// calibration.json (missing and infinite numbers are null):
// - name, about, file, status ("done"), wall_seconds, warnings [...], warning_kinds [...]
// - provenance {...}
// - runs {started, points, failed, phases {phase: points}, with_derivatives}
// - misfit, noise {known, of_residuals}
// - numbers [{name, keys {experiment: [key]}, unit, scale, from, to, start, value, sigma, low,
//   high, determined, derivatives ("run" or "differences"), why_differences}]
// - derivatives {missed, compared}: accuracy of the runs' sensitivities (derivatives.hpp)
// - correlation [[...]], combinations [{text, sigma, weights}]
// - experiments [{name, base, data, x, y, x_unit, y_unit, points, beyond, misfit, rms, noise,
//   weight, fit, run, scene}]
//
// evaluations.csv: number, phase, a column for each fitted parameter, misfit, misfit:EXPERIMENT,
// derivatives (1 if the runs gave them, else 0), status, error.
#pragma once

#include "framework/calibrate/calibration.hpp"
#include "framework/calibrate/calibration_folder.hpp"
#include "framework/output/provenance.hpp"

namespace tack {

struct CalibrationRecord {
  const CalibrateConfig& config;
  std::string file;
  Provenance provenance;
  double wall_seconds = 0;
  int started = 0;  // runs of this call
};

// Writes all files except the pictures. `best_runs`: folders of the best runs. Throws InputError if
// a file cannot be written.
void write_calibration(const CalibrationFolder& folder, const CalibrationRecord& record,
                       const Calibration& calibration, FittedScenes& scenes,
                       const std::vector<std::filesystem::path>& best_runs);

// Draws, for each experiment, the measured points with the best run, and the misfit of every point.
// Returns the error messages.
std::vector<std::string> draw_calibration(const CalibrationFolder& folder,
                                          const Calibration& calibration,
                                          const FittedScenes& scenes);

}  // namespace tack
