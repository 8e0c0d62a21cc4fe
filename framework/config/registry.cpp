#include "framework/config/registry.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "framework/config/field.hpp"
#include "framework/config/nearest.hpp"
#include "framework/config/words.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Function-local, so that they exist before the first registration, whichever that is.
std::map<std::string, const Kind*>& kinds_by_name() {
  static std::map<std::string, const Kind*> kinds;
  return kinds;
}

std::map<std::type_index, std::string>& names_by_class() {
  static std::map<std::type_index, std::string> names;
  return names;
}

// Compilers are called with absolute paths; this file knows where the source tree begins.
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

Kind::Kind(std::string name, std::string doc) : name_(std::move(name)), doc_(std::move(doc)) {
  if (!kinds_by_name().emplace(name_, this).second) {
    throw std::logic_error(fmt::format("two kinds of component are called '{}'", name_));
  }
}

std::vector<std::string> Kind::names() const {
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries_) names.push_back(name);
  return names;
}

const Kind::Entry& Kind::entry(std::string_view name) const {
  const auto found = entries_.find(name);
  if (found != entries_.end()) return found->second;
  throw InputError(
      fmt::format("unknown {} '{}'{}", name_, name, suggestion(name, names(), plural(name_))));
}

Fields Kind::prototype(std::string_view name) const {
  const std::shared_ptr<Component> component = entry(name).factory();
  Fields fields;
  component->fields(fields);
  fields.keep(component);
  return fields;
}

void Kind::add(Entry entry, std::type_index type) {
  entry.file = relative_to_tree(std::move(entry.file));
  const auto present = entries_.find(entry.name);
  if (present != entries_.end()) {
    throw std::logic_error(fmt::format("{} '{}' is registered in {} and again in {}", name_,
                                       entry.name, present->second.file, entry.file));
  }
  const auto [known, is_new] = names_by_class().emplace(type, entry.name);
  if (!is_new) {
    throw std::logic_error(fmt::format("the class of {} '{}' ({}) is already registered as '{}'",
                                       name_, entry.name, entry.file, known->second));
  }
  entries_.emplace(entry.name, std::move(entry));
}

std::vector<const Kind*> registered_kinds() {
  std::vector<const Kind*> kinds;
  for (const auto& [name, kind] : kinds_by_name()) kinds.push_back(kind);
  return kinds;
}

}  // namespace tack
