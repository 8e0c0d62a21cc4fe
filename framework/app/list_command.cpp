// tack list: the components that a scene file can name, and a search for words.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "framework/app/commands.hpp"
#include "framework/catalogue/search.hpp"
#include "framework/config/describe.hpp"
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

}  // namespace

int list_command(const ListOptions& o) {
  for (const std::string& plugin : o.plugins) load_plugin(std::filesystem::absolute(plugin).string());
  if (o.writes_files()) return describe_command(o);
  if (o.kind == study_kind && !is_kind(o.kind)) throw InStudies{};
  if (o.kind.empty()) {
    fmt::print("{}{}", list_kinds(), is_kind(study_kind) ? "" : fmt::format("of batches: tack list {}\n", study_kind));
  } else if (o.name.empty()) {
    fmt::print("{}", is_kind(o.kind) ? list_kind(o.kind) : named(o.kind));
  } else {
    const std::string both = is_kind(o.kind) ? "" : found(o.kind + " " + o.name);
    const bool names_component = is_kind(o.kind) || !list_named(o.name).empty();  // of a kind that may be misspelt
    fmt::print("{}", !both.empty() ? both : names_component ? list_component(o.kind, o.name) : named(o.kind + " " + o.name));
  }
  return exit_done;
}

}  // namespace tack
