// Terminal help and the echo of values.
#include "framework/config/describe.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/config/nearest.hpp"
#include "framework/config/retired_keys.hpp"
#include "framework/config/words.hpp"
#include "framework/config/yaml_text.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

const Kind& kind_called(const std::string& name) {
  std::vector<std::string> names;
  for (const Kind* kind : registered_kinds()) {
    if (kind->name() == name) return *kind;
    names.push_back(kind->name());
  }
  throw InputError(fmt::format("unknown kind '{}'{}", name, suggestion(name, names, "kinds")));
}

std::string rows(const std::vector<std::pair<std::string, std::string>>& table) {
  std::size_t width = 0;
  for (const auto& [name, text] : table) width = std::max(width, name.size());
  std::string out;
  for (const auto& [name, text] : table) out += fmt::format("  {:<{}}  {}\n", name, width, text);
  return out;
}

std::string facts(const Field& f) {
  std::string text = f.shape.noun();
  if (!f.constraint().empty()) text += ", " + f.constraint();
  const std::string initial = default_text(f);
  if (f.mandatory || f.shape.nullable) return text + ", " + initial;
  return nested_object(f.shape) ? text : text + ", default " + initial;
}

void describe_fields(const Fields& fields, const std::string& prefix, std::string& out) {
  for (const Field& f : fields.all()) {
    out += fmt::format("  {}{}: {}\n      {}\n", prefix, f.key, facts(f), f.doc);
    for (const Shape::Option& o : f.shape.options) {
      out += fmt::format("      {}: {}\n", o.name, o.doc);
    }
    if (!f.instead.empty()) out += fmt::format("      deprecated: {}\n", f.instead);
    for (const std::string& name : retired_names(f, fields))
      out += fmt::format("      deprecated name: {}\n", name);
    if (const Shape* inner = nested_object(f.shape)) {
      const std::string many = f.shape.form == Shape::Form::object ? "." : "[].";
      describe_fields(inner->prototype(), fmt::format("{}{}{}", prefix, f.key, many), out);
    }
  }
}

}  // namespace

const Shape* nested_object(const Shape& shape) {
  if (shape.form == Shape::Form::object) return &shape;
  return shape.entry ? nested_object(*shape.entry) : nullptr;
}

std::string default_text(const Field& field) {
  if (field.mandatory) return "required";
  const Value v = field.write();
  if (v.is_null()) return "unset";
  const Value* type = field.shape.form == Shape::Form::component ? v.find("type") : nullptr;
  return type ? type->text : inline_text(v);
}

std::string list_kinds() {
  std::vector<std::pair<std::string, std::string>> table;
  for (const Kind* kind : registered_kinds()) table.emplace_back(kind->name(), kind->doc());
  return rows(table);
}

std::string list_kind(const std::string& name) {
  const Kind& kind = kind_called(name);
  kind.complete();
  std::vector<std::pair<std::string, std::string>> table;
  for (const auto& [key, entry] : kind.entries()) {
    table.emplace_back(key, entry.doc);
    if (const std::string traits = entry.factory()->traits_text(); !traits.empty()) table.emplace_back("", "  " + traits);
  }
  return fmt::format("{}: {}\n{}", kind.name(), kind.doc(), rows(table));
}

std::string list_component(const std::string& kind_name, const std::string& name) {
  const Kind& kind = kind_called(kind_name);
  const Kind::Entry& entry = kind.entry(name);
  std::string out = fmt::format("{} '{}': {}\n", kind.name(), entry.name, entry.doc);
  if (const std::string traits = entry.factory()->traits_text(); !traits.empty()) out += traits + "\n";
  if (!entry.source.empty()) out += fmt::format("source: {}\n", entry.source);
  out += fmt::format("file: {}\n", entry.file);
  if (!entry.plugin.empty()) out += fmt::format("plugin: {}\n", entry.plugin);
  const Fields fields = kind.prototype(name);
  if (!fields.all().empty()) out += "parameters:\n";
  describe_fields(fields, "", out);
  return out;
}

std::string list_named(const std::string& name) {
  std::string out;
  for (const Kind* kind : registered_kinds()) {
    if (kind->name() == name) return "";
    const std::vector<std::string> names = kind->names();
    if (std::find(names.begin(), names.end(), name) != names.end()) out += (out.empty() ? "" : "\n") + list_component(kind->name(), name);
  }
  return out;
}

std::string to_yaml(const Fields& fields) { return yaml_text(to_value(fields)); }

}  // namespace tack
