// A calibration from its file to its folder.
#pragma once

#include "framework/batch/batch_description.hpp"
#include "framework/calibrate/calibration_files.hpp"

namespace tack {

struct CalibrationSettings {
  std::string file;        // for the records; absolute
  std::string output;      // empty: results/<name>
  std::string program;     // the executable that runs a case, `program run SCENE -o FOLDER ...`
  BatchDescription cases;  // limits and provenance of the runs (calibration_description())
  Provenance provenance;
  bool slurm = false, rerun_failed = false;
};

/// Returns the description of the runs of a calibration, without cases. jobs, threads: 0: as the
/// file says.
BatchDescription calibration_description(const CalibrateConfig& config, const FittedScenes& scenes,
                                         const std::string& file, const Provenance& provenance,
                                         int jobs, int threads);

/// Called while a calibration runs; each may be empty.
struct CalibrationObserver {
  std::function<void(const std::string& line)> print;
  SearchProgress phase;
  std::function<void(const PointEvaluation&)> evaluated;
  std::function<void()> tick;
};

struct CalibrationRun {
  CalibrationFolder folder;
  Calibration calibration;
  int started = 0;  // runs of this call
};
/// Fits the parameters and writes the folder; a later call continues an interrupted one. Throws
/// Interrupted after the tables are written, InputError, and SimulationError.
CalibrationRun run_calibration(const CalibrateConfig& config, FittedScenes& scenes,
                               const CalibrationSettings& settings,
                               const CalibrationObserver& observer);

}  // namespace tack
