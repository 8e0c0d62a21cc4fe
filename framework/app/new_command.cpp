// tack new: writes a template of a scene.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "framework/app/commands.hpp"
#include "framework/catalogue/scene_templates.hpp"
#include "framework/config/nearest.hpp"
#include "framework/config/read_file.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

// Returns the text of a template whose line for editors names the schema by its absolute path.
std::string text_of(const SceneTemplate& scene) {
  std::string text = read_file(scene.file.string(), largest_text);
  const std::string line = "# yaml-language-server: $schema=";
  std::error_code none;
  const fs::path schema = fs::canonical(document_folder() / "scene.schema.json", none);
  if (text.starts_with(line)) text.replace(0, text.find('\n') + 1, schema.empty() ? "" : line + schema.string() + "\n");
  return text;
}

void print_templates(const std::vector<SceneTemplate>& templates) {
  size_t width = 0;
  for (const SceneTemplate& t : templates) width = std::max(width, t.name.size());
  for (const SceneTemplate& t : templates) fmt::print("  {:<{}}  {}\n", t.name, width, t.about);
  fmt::print("`tack new NAME` writes one to a file, probe_tack.yaml for probe-tack\n");
}

}  // namespace

int new_command(const NewOptions& o) {
  const std::vector<SceneTemplate> templates = scene_templates(template_folder());
  if (templates.empty()) throw InputError(fmt::format("{}: there are no templates; install tack again, or configure its build again", template_folder().string()));
  if (o.name.empty()) {
    if (!o.output.empty()) throw InputError("tack new -o FILE: which template? `tack new` lists them");
    print_templates(templates);
    return exit_done;
  }
  std::string name = o.name;
  std::replace(name.begin(), name.end(), '_', '-');
  const auto found = std::find_if(templates.begin(), templates.end(), [&](const SceneTemplate& t) { return t.name == name; });
  if (found == templates.end()) {
    std::vector<std::string> names;
    for (const SceneTemplate& t : templates) names.push_back(t.name);
    throw InputError(fmt::format("unknown template '{}'{}", o.name, suggestion(name, names, "templates")));
  }
  const fs::path output = o.output.empty() ? fs::path(found->file.filename()) : fs::path(o.output);
  if (std::error_code none; fs::exists(output, none)) throw InputError(fmt::format("{}: is there already, and is not replaced; choose another file with -o", output.string()));
  replace_file(output, text_of(*found));
  fmt::print("{}: change its `parameters`, then `tack check {}` and `tack run {}`\n", output.string(), output.string(), output.string());
  return exit_done;
}

}  // namespace tack
