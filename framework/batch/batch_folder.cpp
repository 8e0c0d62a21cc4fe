#include "framework/batch/batch_folder.hpp"

#include <fmt/format.h>

#include "framework/output/run_folder.hpp"
#include "geometry/errors.hpp"

namespace tack {

namespace fs = std::filesystem;

BatchFolder BatchFolder::found(const fs::path& root) {
  BatchFolder folder{fs::weakly_canonical(fs::absolute(root)), nullptr};
  if (fs::exists(folder.description())) return folder;
  throw InputError(fmt::format("{}: holds no batch (no batch.json); give the folder that `tack batch` made", folder.root.string()));
}

BatchFolder BatchFolder::opened(const fs::path& root, bool other) {
  BatchFolder folder{fs::weakly_canonical(fs::absolute(root)), nullptr};
  if (other || !fs::exists(folder.description())) folder.moved_aside = RunFolder::create(folder.root).moved_aside();
  folder.lock = std::make_shared<FolderLock>(folder.root);
  std::error_code failed;
  for (const char* name : {"scenes", "cases", "state", "output"}) {
    fs::create_directories(folder.root / name, failed);
    if (failed)
      throw InputError(fmt::format("{}: cannot be made ({}); choose another results folder with -o", (folder.root / name).string(),
                                   failed.message()));
  }
  return folder;
}

}  // namespace tack
