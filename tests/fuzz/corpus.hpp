// What is damaged: meshes, scenes and stored states, and how the program is called with each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tack {

struct Sample {
  std::filesystem::path path;  // of the file that is damaged, in a scratch folder
  std::string content;         // whole
  std::vector<std::vector<std::string>> commands;  // that read it, in turn
  std::filesystem::path directory;                 // that they run in
  bool must_refuse = false;                        // any damage has to be noticed: exit code 2
};

// KIND: meshes, scenes, states. Fills the scratch folder. Throws std::runtime_error if it cannot.
std::vector<Sample> corpus(const std::string& kind, const std::filesystem::path& scratch);

}  // namespace tack
