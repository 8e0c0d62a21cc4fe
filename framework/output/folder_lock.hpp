// One writer a results folder. The lock is the kernel's (flock) on the file .tack_run inside, so it ends with
// the process that holds it, however that dies. The file says which process it is.
#pragma once

#include <filesystem>

namespace tack {

class FolderLock {
 public:
  // Locks an existing folder, and marks it as a run's by the way. Throws InputError if another process (or
  // this one) writes into it, or if it cannot be written. A file system that knows no locks does without.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

  // Whether a folder has been one of a run.
  static bool marked(const std::filesystem::path& folder);
  // Whether somebody writes into it at present. Who locks it at the same moment waits for microseconds.
  static bool held(const std::filesystem::path& folder);

 private:
  int file_ = -1;
};

}  // namespace tack
