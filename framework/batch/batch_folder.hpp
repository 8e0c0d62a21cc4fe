// Where a batch keeps what: results/NAME, which a later call of the same batch goes on with.
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
  std::optional<std::filesystem::path> moved_aside = {};  // where what was there went

  std::filesystem::path description() const { return root / "batch.json"; }
  std::filesystem::path table() const { return root / "results.csv"; }
  std::filesystem::path scene(const std::string& name) const { return root / "scenes" / (name + ".yaml"); }
  std::filesystem::path run(const std::string& name) const { return root / "cases" / name; }
  std::filesystem::path state(const std::string& name) const { return root / "state" / (name + ".json"); }
  std::filesystem::path output(const std::string& name) const { return root / "output" / (name + ".txt"); }
  std::filesystem::path job_script() const { return root / "slurm.sh"; }

  // Of a batch that is there, only to be read or for one of its cases. Throws InputError if it is none.
  static BatchFolder found(const std::filesystem::path& root);

  // With its subfolders, for one writer at a time. Something that is no batch, results of a run with the same name, is moved aside, and so is
  // another batch, if it is one; a folder with anything else is refused. Throws InputError.
  static BatchFolder opened(const std::filesystem::path& root, bool other = false);
};

}  // namespace tack
