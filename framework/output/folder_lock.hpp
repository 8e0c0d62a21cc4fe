// Lock of a results folder, for one writer at a time. It is a kernel lock (flock) on the file
// .tack_run inside, which ends with its process, however that dies. The file names the process.
#pragma once

#include <filesystem>

namespace tack {

class FolderLock {
 public:
  // Locks an existing folder and marks it as a run's. Throws InputError if it is locked already,
  // also by this process, or cannot be written. On file systems without locks it only marks.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

  // Returns true if a folder is or was a run's.
  static bool marked(const std::filesystem::path& folder);
  // Returns true if a process has the lock now. A process that locks at the same moment waits for
  // microseconds.
  static bool is_locked(const std::filesystem::path& folder);

 private:
  int file_ = -1;
};

}  // namespace tack
