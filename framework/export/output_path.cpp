#include "framework/export/output_path.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>

#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr const char* marker = ".tack_export";

bool same(const fs::path& a, const fs::path& b) {
  std::error_code none;
  return fs::equivalent(a, b, none);
}

}  // namespace

void check_file_output(const fs::path& output, const std::vector<fs::path>& sources) {
  std::error_code none;
  if (fs::is_directory(output, none)) throw InputError(fmt::format("{}: is a folder, and this format writes one file; give its name with -o", output.string()));
  for (const fs::path& source : sources)
    if (same(output, source)) throw InputError(fmt::format("{}: the scene reads this file, which the export would replace; give another name with -o", output.string()));
}

void check_folder_output(const fs::path& output, const std::vector<fs::path>& sources) {
  std::error_code none;
  if (!fs::exists(output, none)) return;
  if (!fs::is_directory(output, none)) throw InputError(fmt::format("{}: is a file, and this format writes a folder of files; give a folder with -o", output.string()));
  for (const fs::path& source : sources)
    if (same(output, source.parent_path()))
      throw InputError(fmt::format("{}: holds {}, which the scene reads and the export could replace; give another folder with -o", output.string(), source.filename().string()));
  if (!fs::is_empty(output, none) && !fs::exists(output / marker, none))
    throw InputError(fmt::format("{}: holds files that no export wrote; give a new or empty folder with -o", output.string()));
}

void mark_exported(const fs::path& folder) {
  std::error_code failed;  // writing reports the error
  fs::create_directories(folder, failed);
  errno = 0;
  if (!std::ofstream(folder / marker, std::ios::app)) throw InputError(write_failure(folder / marker));
}

}  // namespace tack
