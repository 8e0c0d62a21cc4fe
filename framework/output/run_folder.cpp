#include "framework/output/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

#include "framework/output/replace_file.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr const char* marker = ".tack_run";

bool is_run(const fs::path& folder) { return fs::is_regular_file(folder / marker); }

// Moving the working directory away would pull the ground from under relative paths.
bool holds_working_directory(const fs::path& folder) {
  const fs::path here = fs::weakly_canonical(fs::current_path());
  const fs::path root = fs::weakly_canonical(folder);
  return std::mismatch(root.begin(), root.end(), here.begin(), here.end()).first == root.end();
}

fs::path free_name(const fs::path& folder) {
  for (int i = 1;; ++i) {
    fs::path name = folder.string() + fmt::format(".{}", i);
    if (!fs::exists(fs::symlink_status(name))) return name;
  }
}

fs::path move_aside(const fs::path& folder) {
  const fs::path real = fs::canonical(folder);  // through a link, not the link itself
  const fs::path aside = free_name(real);
  fs::rename(real, aside);
  return aside;
}

void refuse(const fs::path& root, std::string_view why) {
  throw InputError(fmt::format("{}: {}; choose another results folder with -o", root.string(), why));
}

std::optional<fs::path> make_way(const fs::path& root) {
  if (holds_working_directory(root)) refuse(root, "is the working directory or holds it");
  if (!fs::exists(root)) return std::nullopt;
  if (!fs::is_directory(root)) refuse(root, "is a file");
  if (is_run(root)) return move_aside(root);
  if (!fs::is_empty(root)) refuse(root, "holds something other than a run of tack");
  return std::nullopt;
}

}  // namespace

RunFolder RunFolder::create(const fs::path& root) {
  // Without a trailing slash, which would put the name of the older run inside the folder.
  const fs::path folder = fs::absolute(root / "").lexically_normal().parent_path();
  RunFolder made(folder);
  try {
    made.moved_aside_ = make_way(folder);
    fs::create_directories(folder);
    replace_file(folder / marker, "This folder holds the results of a run of tack.\n");
    fs::create_directory(made.frames());
    fs::create_directory(made.checkpoints());
  } catch (const fs::filesystem_error& e) {
    refuse(folder, fmt::format("cannot be made ({})", e.code().message()));
  }
  return made;
}

RunFolder RunFolder::open(const fs::path& root) {
  if (is_run(root)) return RunFolder(root);
  throw InputError(fmt::format("{}: is not the results folder of a run; give the folder that was "
                               "made by `tack run`",
                               root.string()));
}

fs::path RunFolder::default_root(std::string_view scene_name) {
  std::string name(scene_name);
  const auto troubles = [](unsigned char c) {
    return c < 0x80 && !std::isalnum(c) && c != '-' && c != '_' && c != '.';
  };
  std::replace_if(name.begin(), name.end(), troubles, '_');
  if (name.empty()) name = "scene";
  if (name.front() == '.') name.front() = '_';
  return fs::path("results") / name;
}

fs::path RunFolder::frame(int number) {
  return fs::path("frames") / fmt::format("frame_{:06}.vtu", number);
}

}  // namespace tack
