#include "framework/calibrate/calibration_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/output/run_folder.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

std::string name_in(const fs::path& description) {
  std::ifstream in(description);
  const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  return json.is_object() && json.contains("name") && json["name"].is_string() ? json["name"].get<std::string>() : "";
}

}  // namespace

CalibrationFolder CalibrationFolder::opened(const fs::path& root, const std::string& name) {
  CalibrationFolder folder{fs::weakly_canonical(fs::absolute(root)), {}, nullptr};
  if (name_in(folder.description()) != name) {
    folder.moved_aside = RunFolder::create(folder.root).moved_aside();
    replace_file(folder.description(), nlohmann::json{{"name", name}, {"status", "running"}}.dump(2) + "\n");
  }
  folder.lock = std::make_shared<FolderLock>(folder.root);
  std::error_code failed;
  for (const char* inner : {"evaluations", "fits", "scenes", "plots"}) {
    fs::create_directories(folder.root / inner, failed);
    if (failed)
      throw InputError(fmt::format("{}: cannot be made ({}); choose another results folder with -o", (folder.root / inner).string(), failed.message()));
  }
  folder.evaluations = BatchFolder::opened(folder.root / "evaluations");
  return folder;
}

}  // namespace tack
