#include "framework/output/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "framework/output/file_names.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

// Moving the working directory would break relative paths.
bool contains_working_directory(const fs::path& folder) {
  const fs::path here = fs::weakly_canonical(fs::current_path());
  const auto differing = std::mismatch(folder.begin(), folder.end(), here.begin(), here.end());
  return differing.first == folder.end();
}

fs::path free_name(const fs::path& folder) {
  for (int i = 1;; ++i) {
    fs::path name = folder.string() + fmt::format(".{}", i);
    if (!fs::exists(fs::symlink_status(name))) return name;
  }
}

// Throws if a run writes into the folder.
fs::path move_aside(const fs::path& folder) {
  const FolderLock lock(folder);
  fs::path aside = free_name(folder);
  fs::rename(folder, aside);
  return aside;
}

// Follows links, so that a link to another disk remains. Removes a trailing slash, which would put
// the name of the older run inside the folder.
fs::path real_path(const fs::path& root) {
  const fs::path real = fs::weakly_canonical(fs::absolute(root));
  return real.has_filename() ? real : real.parent_path();
}

[[noreturn]] void refuse_folder(const fs::path& root, std::string_view why) {
  throw InputError(
      fmt::format("{}: {}; choose another results folder with -o", root.string(), why));
}

// Moves an earlier run at the path aside. Throws InputError for other contents.
std::optional<fs::path> clear_path(const fs::path& root) {
  if (contains_working_directory(root)) refuse_folder(root, "is the working directory or contains it");
  if (!fs::exists(root)) return std::nullopt;
  if (!fs::is_directory(root)) refuse_folder(root, "is a file");
  if (FolderLock::marked(root)) return move_aside(root);
  if (!fs::is_empty(root)) refuse_folder(root, "contains other files than those of a run of tack");
  return std::nullopt;
}

}  // namespace

RunFolder RunFolder::create(const fs::path& root) {
  try {
    RunFolder made(real_path(root));
    made.moved_aside_ = clear_path(made.root_);
    fs::create_directories(made.root_);
    made.lock_ = std::make_shared<FolderLock>(made.root_);
    return made;
  } catch (const fs::filesystem_error& e) {
    refuse_folder(root, fmt::format("cannot be made ({})", e.code().message()));
  }
}

RunFolder RunFolder::open(const fs::path& root) {
  if (FolderLock::marked(root)) {
    RunFolder opened(root);
    opened.lock_ = std::make_shared<FolderLock>(root);
    return opened;
  }
  throw InputError(
      fmt::format("{}: is not the results folder of a run; give the folder that was "
                  "made by `tack run`",
                  root.string()));
}

fs::path RunFolder::default_root(std::string_view scene_name) {
  return fs::path("results") / (scene_name.empty() ? "scene" : file_name(std::string(scene_name)));
}

fs::path RunFolder::chosen_root(const std::string& output, std::string_view scene_name) {
  return output.empty() ? default_root(scene_name) : fs::path(output);
}

fs::path RunFolder::frame(int number) {
  return fs::path("frames") / fmt::format("frame_{:06}.vtu", number);
}

}  // namespace tack
