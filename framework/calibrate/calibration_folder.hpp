// Where a calibration keeps what: results/NAME, which a later call goes on with.
//
//   calibration.json   what it is, what came out (calibration_files.hpp)
//   calibration.csv    a row for each number
//   evaluations.csv    a row for each point
//   fits/NAME.csv      of each experiment: x, measured, simulated; fits/NAME_run.csv: the whole of its best run
//   scenes/NAME.yaml   of each scene: with the fitted values, every key
//   plots/             pictures
//   evaluations/       the runs, a batch (batch_folder.hpp)
#pragma once

#include "framework/batch/batch_folder.hpp"

namespace tack {

struct CalibrationFolder {
  std::filesystem::path root;  // absolute
  BatchFolder evaluations;
  std::shared_ptr<FolderLock> lock;
  std::optional<std::filesystem::path> moved_aside = {};  // where what was there went

  std::filesystem::path description() const { return root / "calibration.json"; }
  std::filesystem::path numbers() const { return root / "calibration.csv"; }
  std::filesystem::path table() const { return root / "evaluations.csv"; }
  std::filesystem::path fit(const std::string& experiment) const { return root / "fits" / (experiment + ".csv"); }
  std::filesystem::path run(const std::string& experiment) const { return root / "fits" / (experiment + "_run.csv"); }
  std::filesystem::path scene(const std::string& run) const { return root / "scenes" / (run + ".yaml"); }
  std::filesystem::path plots() const { return root / "plots"; }

  // For one writer at a time. Goes on with a calibration of that name; anything else that `tack` wrote is moved aside, a folder with anything else refused.
  // Throws InputError.
  static CalibrationFolder opened(const std::filesystem::path& root, const std::string& name);
};

// A name as that of a file: what troubles shells and file systems is replaced.
std::string file_name(const std::string& name);

}  // namespace tack
