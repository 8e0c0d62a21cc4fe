// Layout of the folder of a batch, results/NAME, which a later call of the batch continues.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "framework/output/folder_lock.hpp"

namespace tack {

struct BatchFolder {
  std::filesystem::path root;  // absolute
  std::shared_ptr<FolderLock> lock;
  std::optional<std::filesystem::path> moved_aside = {};  // new path of the folder that was there

  std::filesystem::path description() const { return root / "batch.json"; }
  std::filesystem::path table() const { return root / "results.csv"; }
  std::filesystem::path hdf5() const { return root / "results.h5"; }
  std::filesystem::path scene(const std::string& name) const {
    return root / "scenes" / (name + ".yaml");
  }
  std::filesystem::path run(const std::string& name) const { return root / "cases" / name; }
  std::filesystem::path state(const std::string& name) const {
    return root / "state" / (name + ".json");
  }
  std::filesystem::path output(const std::string& name) const {
    return root / "output" / (name + ".txt");
  }
  std::filesystem::path job_script() const { return root / "slurm.sh"; }
  std::filesystem::path tasks() const { return root / "tasks.jsonl"; }

  // Opens an existing batch, to read it or to run one of its cases. Throws InputError if the folder
  // has none.
  static BatchFolder found(const std::filesystem::path& root);

  // Opens or creates the folder with its subfolders, for one writer at a time.
  // - results of a run with the same name, and another batch if `other`, are moved aside
  // - a folder with anything else is refused: throws InputError
  static BatchFolder opened(const std::filesystem::path& root, bool other = false);
};

}  // namespace tack
