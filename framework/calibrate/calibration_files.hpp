// The files of a calibration.
//
// calibration.json: name, about, file, provenance {...}, status ("done"), wall_seconds, runs {started, points, failed, phases {phase: points},
// with_derivatives}, misfit, noise {known, of_residuals}, numbers [{name, keys {experiment: [key]}, unit, scale, from, to, start, value, sigma, low, high,
// determined, derivatives ("run" or "differences"), why_differences}], derivatives {missed, compared} (those of the runs themselves), correlation [[...]], combinations [{text, sigma,
// weights}], experiments [{name, base, data, x, y, x_unit, y_unit, points, beyond, misfit, rms, noise, weight, fit, run, scene}], warnings [...]. Numbers that
// there are not, or that are infinite, are null.
// evaluations.csv: number, phase, a column for each fitted number, misfit, misfit:EXPERIMENT, derivatives (1 or 0: whether the runs gave them), status, error.
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
  int started = 0;  // runs, this time
};

// Everything but the pictures. `best_runs`: the folders of the best runs. Throws InputError for what cannot be written.
void write_calibration(const CalibrationFolder& folder, const CalibrationRecord& record, const Calibration& found, FittedScenes& scenes,
                       const std::vector<std::filesystem::path>& best_runs);

// Of each experiment measured points with the best run, and the misfit from point to point. What is wrong with any of them.
std::vector<std::string> draw_calibration(const CalibrationFolder& folder, const Calibration& found, const FittedScenes& scenes);

}  // namespace tack
