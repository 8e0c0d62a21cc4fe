// tack list: the components that a scene file can name, and a search for words.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "framework/app/commands.hpp"
#include "framework/catalogue/search.hpp"
#include "framework/config/describe.hpp"
#include "framework/config/nearest.hpp"
#include "framework/config/registry.hpp"
#include "framework/experiment/experiment.hpp"
#include "framework/plugin/plugins.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Returns the kind of that name; nullptr if there is none.
const Kind* kind_named(const std::string& name) {
  for (const Kind* kind : registered_kinds())
    if (kind->name() == name) return kind;
  return nullptr;
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

// Returns the text of a component of a kind. The kind's name may also be the first word of a search:
// "probe tack". Throws InputError for a name that is neither.
std::string component_or_found(const Kind& kind, const std::string& name) {
  const std::string text = nearest(name, kind.names()).empty() ? found(kind.name() + " " + name) : "";
  return text.empty() ? list_component(kind.name(), name) : text;
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
  const Kind* kind = kind_named(o.kind);
  if (o.kind == study_kind && !kind) throw InStudies{};
  if (o.kind.empty()) {
    fmt::print("{}{}", list_kinds(), kind_named(study_kind) ? "" : fmt::format("of batches: tack list {}\n", study_kind));
  } else if (o.names.empty()) {
    fmt::print("{}", kind ? list_kind(o.kind) : named(o.kind));
  } else {
    const std::string name = fmt::format("{}", fmt::join(o.names, " ")), both = o.kind + " " + name;
    fmt::print("{}", kind ? component_or_found(*kind, name) : found_or_component(o.kind, name, both));
  }
  return exit_done;
}

}  // namespace tack
