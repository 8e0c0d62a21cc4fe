#include "framework/app/scene_options.hpp"

#include <algorithm>

namespace tack {

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command.add_option("file", options.file, "the experiment (YAML); required");
  command.add_option("--set", options.overrides, "override keys: a.b=c (one or more; repeatable)")
      ->take_all()->allow_extra_args(true);
}

void settle(SceneOptions& options) {
  std::vector<std::string>& values = options.overrides;
  if (options.file.empty()) {
    const auto file = std::find_if(values.begin(), values.end(), [](const std::string& value) {
      return value.find('=') == std::string::npos;
    });
    if (file == values.end()) throw CLI::RequiredError("file");
    options.file = *file;
    values.erase(file);
  }
}

}  // namespace tack
