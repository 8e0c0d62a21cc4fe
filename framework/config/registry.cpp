#include "framework/config/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "framework/config/field.hpp"
#include "framework/config/nearest.hpp"
#include "framework/config/words.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

struct NamedKind {
  std::unique_ptr<Kind> kind;
  std::type_index base;
};

// Function-local, so that the map exists before the first registration.
std::map<std::string, NamedKind>& kinds_by_name() {
  static std::map<std::string, NamedKind> kinds;
  return kinds;
}

PluginRegistrations* loading = nullptr;

std::map<std::type_index, std::string>& names_by_class() {
  static std::map<std::type_index, std::string> names;
  return names;
}

LoadableComponents& loadable_components() {
  static LoadableComponents components;
  return components;
}

const std::vector<std::string>& loadable_names(const std::string& kind) {
  static const std::vector<std::string> none;
  const auto found = loadable_components().names.find(kind);
  return found == loadable_components().names.end() ? none : found->second;
}

bool among(const std::vector<std::string>& names, std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); }

// Returns a path relative to the source tree. Compilers get absolute paths; the path of this file
// shows where the tree begins.
std::string relative_to_tree(std::string file) {
  const std::string_view here = __FILE__;
  const std::string_view inside = "framework/config/registry.cpp";
  if (!here.ends_with(inside)) return file;
  const std::string_view root = here.substr(0, here.size() - inside.size());
  return file.starts_with(root) ? file.substr(root.size()) : file;
}

}  // namespace

std::string_view Component::type() const {
  const auto found = names_by_class().find(typeid(*this));
  return found == names_by_class().end() ? std::string_view() : found->second;
}

Kind& Kind::named(const char* name, const char* doc, std::type_index base) {
  auto found = kinds_by_name().find(name);
  if (found == kinds_by_name().end())
    found = kinds_by_name().emplace(name, NamedKind{std::make_unique<Kind>(name, doc), base}).first;
  if (found->second.base != base) throw std::logic_error(fmt::format("two kinds of component are called '{}'", name));
  return *found->second.kind;
}

std::vector<std::string> Kind::names() const {
  const std::vector<std::string>& others = loadable_names(name_);
  std::set<std::string> names(others.begin(), others.end());
  for (const auto& [name, entry] : entries_) names.insert(name);
  return {names.begin(), names.end()};
}

const Kind::Entry& Kind::entry(std::string_view name) const {
  auto found = entries_.find(name);
  if (found == entries_.end() && among(loadable_names(name_), name)) {
    loadable_components().load();
    found = entries_.find(name);
  }
  if (found != entries_.end()) return found->second;
  const std::string similar = suggestion(name, names(), plural(name_));
  const char* plugin = similar.starts_with("; did you mean")
                           ? ""
                           : "; a component of a plugin needs its library under `plugins` of the "
                             "file (--set plugins=[LIBRARY])";
  const std::string search = *plugin ? fmt::format("; `tack list {}` searches for a word of the field", name) : "";
  throw InputError(fmt::format("unknown {} '{}'{}{}{}", name_, name, similar, search, plugin));
}

void Kind::complete() const {
  for (const std::string& name : loadable_names(name_)) entry(name);
}

Fields Kind::prototype(std::string_view name) const {
  const std::shared_ptr<Component> component = entry(name).factory();
  Fields fields;
  component->fields(fields);
  fields.keep(component);
  return fields;
}

void Kind::add(Entry entry, std::type_index type) {
  const auto refuse = [](const std::string& why) {
    if (!loading) throw std::logic_error(why);
    loading->errors_.push_back(why);
  };
  entry.file = relative_to_tree(std::move(entry.file));
  const auto present = entries_.find(entry.name);
  if (present != entries_.end()) {
    return refuse(fmt::format("{} '{}' is registered in {} and again in {}", name_, entry.name, present->second.file,
                              entry.file));
  }
  if (loading && among(loadable_names(name_), entry.name))
    return refuse(fmt::format("{} '{}' is one of tack's own, and registered again in {}", name_, entry.name, entry.file));
  const auto [known, is_new] = names_by_class().emplace(type, entry.name);
  if (!is_new) {
    return refuse(fmt::format("the class of {} '{}' ({}) is already registered as '{}'", name_, entry.name, entry.file,
                              known->second));
  }
  if (loading) {
    entry.plugin = loading->plugin_;
    loading->added_.push_back({this, entry.name, type});
  }
  entries_.emplace(entry.name, std::move(entry));
}

PluginRegistrations::PluginRegistrations(std::string plugin) : plugin_(std::move(plugin)) { loading = this; }

PluginRegistrations::~PluginRegistrations() {
  loading = nullptr;
  for (const Added& a : added_) {
    a.kind->entries_.erase(a.name);
    names_by_class().erase(a.type);
  }
}

void set_loadable_components(LoadableComponents components) { loadable_components() = std::move(components); }

std::vector<const Kind*> registered_kinds() {
  std::vector<const Kind*> kinds;
  for (const auto& [name, entry] : kinds_by_name()) kinds.push_back(entry.kind.get());
  return kinds;
}

}  // namespace tack
