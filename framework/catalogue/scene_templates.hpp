// Scenes to begin with: experiments/templates of a build or an installation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tack {

struct SceneTemplate {
  std::string name;   // "probe-tack"
  std::string about;  // what it is, from its first comment
  std::filesystem::path file;
};

// Returns the templates of a folder, sorted by name; none if the folder does not exist. The name is
// that of the file with hyphens.
std::vector<SceneTemplate> scene_templates(const std::filesystem::path& folder);

// Returns the folders of shipped templates and documents.
std::filesystem::path template_folder();
std::filesystem::path document_folder();

}  // namespace tack
