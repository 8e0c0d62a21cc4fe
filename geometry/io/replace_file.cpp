#include "geometry/io/replace_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "geometry/errors.hpp"

namespace tack {

namespace fs = std::filesystem;

std::string write_failure(const fs::path& path) {
  const std::string reason = errno ? fmt::format(" ({})", std::strerror(errno)) : "";
  return fmt::format(
      "{}: cannot be written{}: check the folder, its permissions and the space on "
      "the disk, or choose another path",
      path.string(), reason);
}

namespace {

void rename_draft(const fs::path& draft, const fs::path& path, bool written) {
  std::error_code failed;
  if (written) fs::rename(draft, path, failed);
  if (written && !failed) return;
  if (failed) errno = failed.value();
  const std::string message = write_failure(path);
  fs::remove(draft, failed);
  throw InputError(message);
}

}  // namespace

void replace_file(const fs::path& path, std::string_view content) {
  std::error_code none;
  // /dev/stdout is a link to the standard output.
  const bool special = fs::is_other(path, none) || path.string().starts_with("/dev/");
  const fs::path draft = special ? path : fs::path(path.string() + ".part");
  errno = 0;
  std::ofstream out(draft, std::ios::binary | std::ios::trunc);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (special && out.fail()) throw InputError(write_failure(path));
  if (!special) rename_draft(draft, path, !out.fail());
}

void replace_file_by(const fs::path& path, const std::function<bool(const fs::path&)>& write) {
  const fs::path draft = path.parent_path() / (path.stem().string() + ".part" + path.extension().string());
  errno = 0;
  bool written = false;
  try {
    written = write(draft);
  } catch (...) {
    std::error_code none;
    fs::remove(draft, none);
    throw;
  }
  rename_draft(draft, path, written);
}

}  // namespace tack
