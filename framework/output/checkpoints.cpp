#include "framework/output/checkpoints.hpp"

#include <fmt/format.h>

#include <sstream>

#include "framework/plugin/plugins.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

// Returns the first difference of two texts: "line 12: 'a: 1' there, 'a: 2' here".
std::string first_difference(const std::string& there, const std::string& here) {
  std::istringstream a(there), b(here);
  std::string line_a, line_b;
  for (int line = 1;; ++line) {
    const bool more_a = static_cast<bool>(std::getline(a, line_a));
    const bool more_b = static_cast<bool>(std::getline(b, line_b));
    if (line_a != line_b || more_a != more_b || !more_a)
      return fmt::format("line {}: '{}' there, '{}' here", line, more_a ? line_a : "", more_b ? line_b : "");
  }
}

void check_meshes(const fs::path& path, const StateFile& file, const World& world) {
  for (const auto& [object, here] : file_meshes_of(world)) {
    const auto there = file.file_meshes.find(object);
    const std::string what = there == file.file_meshes.end() ? "it has none there" : difference(there->second, here);
    if (what.empty()) continue;
    throw InputError(fmt::format("{}: object '{}' had another mesh ({}); resume with the mesh file of that run, or start "
                                 "again without --resume", path.string(), object, what));
  }
}

void check_plugins(const fs::path& path, const StateFile& file) {
  for (const auto& [plugin, checksum] : plugin_checksums()) {
    const auto there = file.plugins.find(plugin);
    if (there == file.plugins.end() || there->second == checksum) continue;
    throw InputError(fmt::format("{}: plugin '{}' was rebuilt since then; resume with the library of that run, or start again without "
                                 "--resume", path.string(), plugin));
  }
}

void check_files(const fs::path& path, const StateFile& file, const std::map<std::string, std::string>& files) {
  for (const auto& [name, digest] : files) {
    const auto there = file.files.find(name);
    if (there == file.files.end() || there->second == digest) continue;
    throw InputError(fmt::format("{}: file '{}' has changed since that run read it; resume with the old file, or start again without --resume",
                                 path.string(), name));
  }
}

}  // namespace

std::map<std::string, std::uint32_t> plugin_checksums() {
  std::map<std::string, std::uint32_t> checksums;
  for (const Plugin& plugin : loaded_plugins()) checksums[plugin.path] = plugin.checksum;
  return checksums;
}

std::map<std::string, MeshDigest> file_meshes_of(const World& world) {
  std::map<std::string, MeshDigest> digests;
  for (const Body& body : world.bodies)
    if (body.from_file) digests[body.name] = body.digest;
  return digests;
}

fs::path checkpoint_path(const RunFolder& folder, int step) {
  return folder.checkpoints() / fmt::format("step_{:08}.checkpoint", step);
}

fs::path interrupted_path(const RunFolder& folder, int step) {
  return folder.checkpoints() / fmt::format("step_{:08}.interrupted.checkpoint", step);
}

fs::path newest_checkpoint_in(const fs::path& checkpoints, bool due) {
  fs::path newest;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(checkpoints, none))
    if (entry.path().extension() == ".checkpoint" && !(due && entry.path().stem().extension() == ".interrupted"))
      newest = std::max(newest, entry.path());
  return newest;
}

StateFile newest_checkpoint(const RunFolder& folder, const std::string& scene, const World& world, const std::map<std::string, std::string>& files) {
  const fs::path newest = newest_checkpoint_in(folder.checkpoints());
  if (newest.empty())
    throw InputError(fmt::format("{}: there is no checkpoint to resume from; run with output.checkpoint_interval, "
                                 "or start again without --resume", folder.checkpoints().string()));
  StateFile file = read_state_file(newest, StateFile::Kind::checkpoint);
  if (file.scene != scene)
    throw InputError(fmt::format("{}: is of another scene ({}); resume with the scene of that run ({}), or start "
                                 "again without --resume", newest.string(), first_difference(file.scene, scene),
                                 folder.scene().string()));
  check_meshes(newest, file, world);
  check_plugins(newest, file);
  check_files(newest, file, files);
  return file;
}

}  // namespace tack
