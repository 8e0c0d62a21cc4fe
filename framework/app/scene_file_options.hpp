// The file of a command and `--set`, which commands on scenes share.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "framework/app/commands.hpp"
#include "framework/app/help_formatter.hpp"

namespace tack {

// kind: what the file is, for the help.
inline void add_scene_options(CLI::App& command, SceneOptions& options,
                              const std::string& kind = "scene") {
  command.add_option(file_word, options.file, kind + " file (YAML)")->type_name("YAML");
  command.add_option("--set", options.overrides, "override keys: a.b=c (one or more; repeatable)")
      ->take_all()
      ->allow_extra_args(true);
}

// Adds --plugin to a command. contents: what the libraries bring, for the help.
inline void add_plugins(CLI::App& command, std::vector<std::string>& plugins,
                        const std::string& contents) {
  command
      .add_option("--plugin", plugins, "plugin library with custom " + contents + " (repeatable)")
      ->type_name("LIBRARY")
      ->take_all()
      ->allow_extra_args(false);
}

// --set takes several values and also swallows a file that follows them: the value without '=' is
// the file. Throws CLI::RequiredError without one.
inline void settle(SceneOptions& options) {
  if (!options.file.empty()) return;
  std::vector<std::string>& values = options.overrides;
  const auto file = std::ranges::find_if(
      values, [](const std::string& value) { return value.find('=') == std::string::npos; });
  if (file == values.end()) throw CLI::RequiredError("FILE");
  options.file = *file;
  values.erase(file);
}

}  // namespace tack
