// Layout of the folder of a calibration, results/NAME, which a later call continues.
//
//   calibration.json   description and results (calibration_files.hpp)
//   calibration.csv    a row for each fitted parameter
//   evaluations.csv    a row for each point
//   fits/NAME.csv      per experiment: x, measured, simulated
//   fits/NAME_run.csv  per experiment: all samples of the best run
//   scenes/NAME.yaml   per scene: every key, with the fitted values
//   plots/             pictures
//   evaluations/       the runs, a batch (batch_folder.hpp)
#pragma once

#include "framework/batch/batch_folder.hpp"

namespace tack {

struct CalibrationFolder {
  std::filesystem::path root;  // absolute
  BatchFolder evaluations;
  std::shared_ptr<FolderLock> lock;
  std::optional<std::filesystem::path> moved_aside = {};  // new path of the folder that was there

  std::filesystem::path description() const { return root / "calibration.json"; }
  std::filesystem::path parameters() const { return root / "calibration.csv"; }
  std::filesystem::path table() const { return root / "evaluations.csv"; }
  std::filesystem::path fit(const std::string& experiment) const {
    return root / "fits" / (experiment + ".csv");
  }
  std::filesystem::path run(const std::string& experiment) const {
    return root / "fits" / (experiment + "_run.csv");
  }
  std::filesystem::path scene(const std::string& run) const {
    return root / "scenes" / (run + ".yaml");
  }
  std::filesystem::path plots() const { return root / "plots"; }

  // Opens or creates the folder, for one writer at a time. Continues a calibration of that name and
  // moves other results of tack aside. Throws InputError for a folder with other files.
  static CalibrationFolder opened(const std::filesystem::path& root, const std::string& name);
};

}  // namespace tack
