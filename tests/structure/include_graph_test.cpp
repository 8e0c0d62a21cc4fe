// No include goes up: the sources of a layer include those of their own and of lower layers only.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <regex>
#include <set>

#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// From the ground up. Energies and solvers stand beside each other on the framework.
const std::vector<std::string> layers = {
    "geometry", "framework/config", "framework/plugin", "framework/measured", "framework/core", "framework/assembly", "framework/contact", "framework/bond", "framework/affine", "framework/rod", "framework/load",
    "framework/shapes", "framework/level_set", "framework/meshing",
    "framework/body", "framework/protocol", "framework/motion", "framework/world", "framework/scene", "framework/setup", "framework/checks", "framework/remesh",
    "framework/stepping", "framework/output", "framework/experiment", "framework/export", "framework/probes", "framework/profile",
    "framework/sensitivity", "framework/run", "framework/catalogue", "framework/plot", "framework/law", "framework/compare", "framework/batch", "framework/calibrate", "framework/report", "framework/suite", "framework/view", "framework/app", "energies", "solvers"};

// Of a path relative to the source tree; -1 if it is in none.
int layer_of(const std::string& path) {
  for (size_t i = 0; i < layers.size(); ++i)
    if (path.starts_with(layers[i] + "/")) return static_cast<int>(i);
  return -1;
}

bool may_include(int from, int to) {
  const std::string& top = layers[from];
  if (to < 0) return false;
  if (top == "energies" || top == "solvers") return to == from || !(layers[to] == "energies" || layers[to] == "solvers");
  return to <= from;
}

}  // namespace

TEST_CASE("no include goes up", "[structure]") {
  CHECK(may_include(layer_of("framework/core/a.cpp"), layer_of("geometry/a.hpp")));
  CHECK_FALSE(may_include(layer_of("framework/core/a.cpp"), layer_of("framework/assembly/a.hpp")));
  CHECK_FALSE(may_include(layer_of("solvers/a.cpp"), layer_of("energies/a.hpp")));
  CHECK_FALSE(may_include(layer_of("framework/app/a.cpp"), layer_of("solvers/a.hpp")));
  const std::regex include("\n#include \"([^\"]+)\"");
  int files = 0, includes = 0;
  for (const char* top : {"geometry", "framework", "energies", "solvers"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(TACK_SOURCE_DIR) / top)) {
      if (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp") continue;
      const std::string path = fs::relative(entry.path(), TACK_SOURCE_DIR).string(), text = "\n" + file_text(entry.path());
      const int layer = layer_of(path);
      INFO(path);
      REQUIRE(layer >= 0);
      ++files;
      for (std::sregex_iterator i(text.begin(), text.end(), include), end; i != end; ++i, ++includes) {
        INFO("includes " << (*i)[1]);
        CHECK(may_include(layer, layer_of((*i)[1])));
      }
    }
  CHECK(files > 300);
  CHECK(includes > files);
}

TEST_CASE("files of a contact model are included by contact models alone", "[structure]") {
  // Folders with a registered contact model. Other folders of framework/contact are what models share.
  const fs::path contact = fs::path(TACK_SOURCE_DIR) / "framework/contact";
  const std::regex registers("TACK_REGISTER\\(ContactModel\\b");
  std::set<std::string> models, shared;
  for (const auto& folder : fs::directory_iterator(contact)) {
    if (!folder.is_directory()) continue;
    bool model = false;
    for (const auto& entry : fs::directory_iterator(folder.path()))
      if (entry.path().extension() == ".cpp" && std::regex_search(file_text(entry.path()), registers)) model = true;
    (model ? models : shared).insert("framework/contact/" + folder.path().filename().string() + "/");
  }
  CHECK(models.size() >= 5);
  CHECK(models.contains("framework/contact/ipc/"));
  CHECK(shared.contains("framework/contact/laws/"));
  const auto of_model = [&](const std::string& path) { return std::any_of(models.begin(), models.end(), [&](const std::string& folder) { return path.starts_with(folder); }); };
  const std::regex include("\n#include \"([^\"]+)\"");
  int included = 0;
  for (const char* top : {"geometry", "framework", "energies", "solvers", "python"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(TACK_SOURCE_DIR) / top)) {
      if (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp") continue;
      const std::string path = fs::relative(entry.path(), TACK_SOURCE_DIR).string(), text = "\n" + file_text(entry.path());
      INFO(path);
      for (std::sregex_iterator i(text.begin(), text.end(), include), end; i != end; ++i) {
        if (!of_model((*i)[1].str())) continue;
        INFO("includes " << (*i)[1]);
        CHECK(of_model(path));
        ++included;
      }
    }
  CHECK(included > 20);
}
