// A temporary folder, deleted with its owner.
#pragma once

#include <filesystem>

namespace tack {

class ScratchFolder {
 public:
  // Throws InputError if the folder cannot be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace tack
