#include "framework/output/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <utility>

#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr const char* marker = ".tack_run";

// Returns the process that the marker names; "" if it names none.
std::string owner(int file) {
  char text[256] = {};
  const auto length = ::pread(file, text, sizeof text - 1, 0);
  const std::string words(text, length > 0 ? static_cast<size_t>(length) : 0);
  const auto at = words.find("process ");
  return at == words.npos ? "" : " (" + words.substr(at, words.find_first_of(".\n", at) - at) + ")";
}

// Attempts to lock; a failed one may only be due to another process that checks the lock.
constexpr int attempts = 3;

bool lock(int file) { return ::flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; }

// Checks that no other process moved the folder between opening and locking.
bool still_there(int file, const fs::path& path) {
  struct stat open = {}, named = {};
  return ::fstat(file, &open) == 0 && ::stat(path.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

}  // namespace

bool FolderLock::marked(const fs::path& folder) { return fs::is_regular_file(folder / marker); }

bool FolderLock::is_locked(const fs::path& folder) {
  const int file = ::open((folder / marker).c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool free = ::flock(file, LOCK_SH | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  ::close(file);
  return !free;
}

FolderLock::FolderLock(const fs::path& folder) {
  const fs::path path = folder / marker;
  errno = 0;
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) throw InputError(write_failure(path));
  bool locked = lock(file_);
  for (int again = 0; !locked && again < attempts; ++again) {
    ::usleep(1000);
    locked = lock(file_);
  }
  if (!locked || !still_there(file_, path)) {
    const std::string who = owner(file_);
    ::close(file_);
    throw InputError(fmt::format("{}: another run{} is writing into this folder; wait until it has ended, or choose "
                                 "another results folder with -o", folder.string(), who));
  }
  const std::string text =
      fmt::format("This folder holds the results of a run of tack, written by process {}.\n", ::getpid());
  if (::ftruncate(file_, 0) != 0 || ::pwrite(file_, text.data(), text.size(), 0) < 0) {
    const std::string failure = write_failure(path);
    ::close(file_);
    throw InputError(failure);
  }
}

FolderLock::~FolderLock() {
  if (file_ >= 0) ::close(file_);
}
FolderLock::FolderLock(FolderLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

}  // namespace tack
