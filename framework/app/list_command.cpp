// tack list: the components that a scene file can name, and a search for words.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "framework/app/commands.hpp"
#include "framework/catalogue/search.hpp"
#include "framework/config/describe.hpp"
#include "framework/config/registry.hpp"
#include "framework/experiment/experiment.hpp"
#include "framework/plugin/plugins.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

bool is_kind(const std::string& name) {
  const std::vector<const Kind*> kinds = registered_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const Kind* kind) { return kind->name() == name; });
}

std::string found(const std::string& query) {
  const Fields scene = prototype<Experiment>();
  return search_text(query, {&scene, scene_templates(template_folder()), page_headings(document_folder())});
}

// Returns the text for a name that is no kind: a component, or what a search finds.
std::string named(const std::string& name) {
  std::string text = list_named(name);
  if (text.empty()) text = found(name);
  if (text.empty())
    throw InputError(fmt::format("nothing is found for '{}': it begins no word of a kind, a component, a key, a template, a page or the field's terms{}", name, nearest_findable(name)));
  return text;
}

// Returns whether a kind has a component of that name, loaded or not.
bool is_component(const std::string& kind_name, const std::string& name) {
  const auto kinds = registered_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const Kind* kind) {
    const std::vector<std::string> names = kind->names();
    return kind->name() == kind_name && std::find(names.begin(), names.end(), name) != names.end();
  });
}

// Returns the text of a component of a kind. The kind's name may also be the first word of a search:
// "probe tack".
std::string component_or_found(const std::string& kind, const std::string& name) {
  if (is_component(kind, name)) return list_component(kind, name);
  try {
    return list_component(kind, name);
  } catch (const InputError& error) {
    const bool misspelt = std::string(error.what()).find("did you mean") != std::string::npos;
    const std::string text = misspelt ? "" : found(kind + " " + name);
    if (text.empty()) throw;
    return text;
  }
}

// Returns what a search finds, or the text of a component whose kind is misspelt.
std::string found_or_component(const std::string& kind, const std::string& name, const std::string& both) {
  const std::string text = found(both);
  if (!text.empty()) return text;
  return list_named(name).empty() ? named(both) : list_component(kind, name);
}

}  // namespace

int list_command(const ListOptions& o) {
  for (const std::string& plugin : o.plugins) load_plugin(std::filesystem::absolute(plugin).string());
  if (o.writes_files()) return describe_command(o);
  if (o.kind == study_kind && !is_kind(o.kind)) throw InStudies{};
  if (o.kind.empty()) {
    fmt::print("{}{}", list_kinds(), is_kind(study_kind) ? "" : fmt::format("of batches: tack list {}\n", study_kind));
  } else if (o.names.empty()) {
    fmt::print("{}", is_kind(o.kind) ? list_kind(o.kind) : named(o.kind));
  } else {
    const std::string name = fmt::format("{}", fmt::join(o.names, " ")), both = o.kind + " " + name;
    fmt::print("{}", is_kind(o.kind) ? component_or_found(o.kind, name) : found_or_component(o.kind, name, both));
  }
  return exit_done;
}

}  // namespace tack
