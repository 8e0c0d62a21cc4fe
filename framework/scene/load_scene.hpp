// From a file on disk to a typed scene.
#pragma once

#include <string>
#include <vector>

#include "framework/scene/scene_config.hpp"

namespace tack {

struct LoadedScene {
  Value root;  // as parsed, for places in messages
  SceneConfig config;
};

// `overrides` are "a.b=c". Throws InputError with file, line and remedy.
LoadedScene load_scene(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace tack
