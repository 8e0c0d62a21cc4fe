#include "framework/scene/load_scene.hpp"

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"

namespace tack {

LoadedScene load_scene(const std::string& path, const std::vector<std::string>& overrides) {
  LoadedScene loaded;
  loaded.root = parse_file(path);
  for (const std::string& assignment : overrides) apply_override(loaded.root, assignment);
  bind(loaded.root, loaded.config, "the scene");
  return loaded;
}

}  // namespace tack
