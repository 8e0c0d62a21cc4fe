#include "framework/catalogue/scene_templates.hpp"

#include <algorithm>
#include <fstream>

#include "geometry/own_library.hpp"

namespace tack {

namespace fs = std::filesystem;

namespace {

// Returns the first comment line of a scene that is not for editors, up to its first full stop.
std::string first_sentence(const fs::path& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("# ") && !line.starts_with("# yaml-language-server")) return line.substr(2, line.find('.') == line.npos ? line.npos : line.find('.') - 2);
  return "";
}

}  // namespace

std::vector<SceneTemplate> scene_templates(const fs::path& folder) {
  std::vector<SceneTemplate> templates;
  std::error_code none;
  if (!fs::is_directory(folder, none)) return templates;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml") continue;
    std::string name = entry.path().stem().string();
    std::replace(name.begin(), name.end(), '_', '-');
    templates.push_back({name, first_sentence(entry.path()), entry.path()});
  }
  std::sort(templates.begin(), templates.end(), [](const SceneTemplate& a, const SceneTemplate& b) { return a.name < b.name; });
  return templates;
}

fs::path template_folder() { return shared_file("experiments/templates"); }
fs::path document_folder() { return shared_file("docs"); }

}  // namespace tack
