// --plugin of commands on scenes.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "framework/app/commands.hpp"
#include "framework/config/parse.hpp"
#include "framework/plugin/plugins.hpp"

namespace tack {
namespace {

// Returns a text as a YAML scalar, for paths with any character.
std::string yaml_scalar(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

}  // namespace

std::vector<std::string> overrides_with_plugins(const SceneOptions& options) {
  std::vector<std::string> overrides = options.overrides, paths;
  if (options.plugins.empty()) return overrides;
  std::vector<std::string> added;
  for (const std::string& plugin : options.plugins) {
    added.push_back(std::filesystem::absolute(plugin).string());
    load_plugin(added.back());
  }
  const Value root = with_overrides(parse_file(options.file), overrides);
  if (const Value* list = root.find("plugins"))
    for (const Value& item : list->items) paths.push_back(resolve_path(item.mark, item.text));
  for (const std::string& path : added)
    if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.push_back(path);
  for (std::string& path : paths) path = yaml_scalar(path);
  overrides.push_back(fmt::format("plugins=[{}]", fmt::join(paths, ", ")));
  return overrides;
}

LoadedExperiment loaded_scene(const SceneOptions& options) { return load_experiment(options.file, overrides_with_plugins(options)); }

}  // namespace tack
