// The experiment file and its overrides, as every command takes that reads a scene.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace tack {

struct SceneOptions {
  std::string file;
  std::vector<std::string> overrides;  // "a.b=c"
};

void add_scene_options(CLI::App& command, SceneOptions& options);

// Call first in the command's callback. --set takes several values and so also a file that stands
// behind them: what has no '=' is the file. Throws CLI::RequiredError without a file.
void settle(SceneOptions& options);

}  // namespace tack
