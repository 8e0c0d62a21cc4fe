#include "framework/export/draft_files.hpp"

#include <cerrno>
#include <fstream>

#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

fs::path draft_of(const fs::path& path) { return path.string() + ".part"; }

}  // namespace

DraftFiles::~DraftFiles() {
  std::error_code none;
  for (const fs::path& path : paths_)
    if (!path.empty()) fs::remove(draft_of(path), none);
}

int DraftFiles::begin(const fs::path& path) {
  std::error_code failed;  // writing reports the error
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), failed);
  errno = 0;
  if (!std::ofstream(draft_of(path), std::ios::binary | std::ios::trunc)) throw InputError(write_failure(path));
  paths_.push_back(path);
  return static_cast<int>(paths_.size()) - 1;
}

void DraftFiles::append(int file, std::string_view bytes) {
  errno = 0;
  std::ofstream out(draft_of(paths_[file]), std::ios::binary | std::ios::app);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (out.fail()) throw InputError(write_failure(paths_[file]));
}

void DraftFiles::append_draft(int file, int other) {
  const fs::path from = draft_of(paths_[other]);
  errno = 0;
  std::ofstream out(draft_of(paths_[file]), std::ios::binary | std::ios::app);
  std::error_code failed;
  if (fs::file_size(from, failed) > 0) out << std::ifstream(from, std::ios::binary).rdbuf();
  out.close();
  if (failed || out.fail()) throw InputError(write_failure(paths_[file]));
  drop(other);
}

void DraftFiles::drop(int file) {
  std::error_code none;
  fs::remove(draft_of(paths_[file]), none);
  paths_[file].clear();
}

void DraftFiles::commit() {
  for (fs::path& path : paths_) {
    if (path.empty()) continue;
    std::error_code failed;
    fs::rename(draft_of(path), path, failed);
    if (failed) {
      errno = failed.value();
      throw InputError(write_failure(path));
    }
    path.clear();
  }
}

}  // namespace tack
