#include "framework/batch/resolved_case.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "framework/config/describe.hpp"
#include "framework/config/file_digest.hpp"
#include "framework/config/parse.hpp"
#include "framework/config/yaml_text.hpp"
#include "framework/experiment/kept_expressions.hpp"
#include "framework/output/checkpoints.hpp"
#include "geometry/checksum.hpp"
#include "geometry/own_library.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

std::string digest_of_text(const std::string& text) {
  return fmt::format("{}-{:08x}", text.size(), crc32_of(text.data(), text.size()));
}

}  // namespace

ResolvedCase CaseResolver::resolve(Value root, const std::vector<Variant::Setting>& set) {
  for (const Variant::Setting& s : set) set_at(root, s.key, s.value);
  ResolvedCase one{bound_experiment(std::move(root)), {}, {}, {}};
  one.resolved = resolved_scene(one.loaded.root, one.loaded.experiment);
  one.scene = yaml_text(one.resolved);
  one.digest = digest_of_text(one.scene);
  for (const std::string& path : named_paths(one.resolved)) one.digest += digest_of_file(path);
  one.digest += " " + program_;
  return one;
}

// Returns the digest of the bytes of a file, or of the newest checkpoint of an earlier run.
const std::string& CaseResolver::digest_of_file(const std::string& name) {
  const auto [known, anew] = files_.try_emplace(name);
  if (!anew) return known->second;
  std::error_code none;
  fs::path path = name;
  if (fs::is_directory(path, none)) path = newest_checkpoint_in(path / "checkpoints");
  if (const std::string digest = file_digest(path); !digest.empty()) known->second = " " + digest;
  return known->second;
}

std::string program_digest() {
  std::string digest = file_digest("/proc/self/exe");
  // In another program, such as Python, the code is in libtack.so.
  if (std::error_code none; !fs::equivalent(own_file(), "/proc/self/exe", none)) digest += "+" + file_digest(own_file());
  // Existing libraries only: building a missing library later makes the cases run once more.
  for (const char* library : {"libtack_further.so", "libtack_meshing.so", "libtack_msh.so"})
    if (const std::string one = file_digest(own_library_path(library)); !one.empty()) digest += "+" + one;
  return digest;
}

}  // namespace tack
