#include "framework/config/schema_required.hpp"

#include <algorithm>
#include <optional>

#include "framework/config/retired_keys.hpp"

namespace tack {
namespace {

using nlohmann::json;
using Form = Shape::Form;

class Required {
 public:
  explicit Required(json& definitions) : definitions_(definitions) {}

  // Returns an empty schema if everything matches.
  json object(const Fields& fields) {
    json required = json::array(), properties = json::object(), schema = json::object();
    for (const Field& f : fields.all()) {
      std::vector<std::string> names = retired_names(f, fields);
      names.insert(names.begin(), f.key);
      if (f.mandatory && names.size() == 1) required.push_back(f.key);
      if (f.mandatory && names.size() > 1) schema["allOf"].push_back(one_of(names));
      if (const json inner = value(f.shape, f); !inner.empty())
        for (const std::string& name : names) properties[name] = inner;
    }
    if (!required.empty()) schema["required"] = required;
    if (!properties.empty()) schema["properties"] = properties;
    return schema;
  }

 private:
  // Returns the schema of a key that has retired names.
  static json one_of(const std::vector<std::string>& names) {
    json any = json::array();
    for (const std::string& name : names) any.push_back({{"required", json::array({name})}});
    return {{"anyOf", any}};
  }

  json value(const Shape& shape, const Field& f) {
    if (shape.form == Form::object) return object(shape.prototype());
    if (shape.form == Form::component) return component(*shape.kind, f);
    if (shape.form != Form::list && shape.form != Form::map) return json::object();
    json entry = value(*shape.entry, f);
    if (merged_by_name(shape)) {
      if (entry.contains("$ref")) entry = {{"allOf", json::array({entry})}};  // draft 7 ignores a $ref's siblings
      for (const auto& [key, doc] : merging_flags) entry["properties"][key] = false;
    }
    if (entry.empty()) return entry;
    return {{shape.form == Form::list ? "items" : "additionalProperties", entry}};
  }

  // With a default component, a map without `type` sets the default's parameters.
  json component(const Kind& kind, const Field& f) {
    json chosen = schema_reference(define(kind));
    const Value current = f.shape.form == Form::component ? f.write() : Value();
    const Value* type = current.find("type");
    if (!type || type->text.empty()) return chosen;
    json own = object(kind.prototype(type->text));
    own["$comment"] = "of the default";
    return {{"anyOf", json::array({chosen, {{"allOf", json::array({schema_reference(component_definition(kind, type->text)), own})}}})}};
  }

  std::string define(const Kind& kind) {
    std::string name = "required." + kind.name();
    if (definitions_.contains(name)) return name;
    // Guards against recursion: components may contain components of their own kind.
    definitions_[name] = nullptr;
    json variants = json::array();
    for (const auto& [component, entry] : kind.entries()) {
      json own = object(kind.prototype(component));
      if (own.empty()) continue;
      const json chosen{{"required", json::array({"type"})}, {"properties", {{"type", {{"const", component}}}}}};
      variants.push_back({{"if", chosen}, {"then", std::move(own)}});
    }
    json then{{"required", json::array({"type"})}};
    if (!variants.empty()) then["allOf"] = variants;
    definitions_[name] = {{"if", {{"type", "object"}}}, {"then", then}};
    return name;
  }

  json& definitions_;
};

}  // namespace

json schema_reference(const std::string& definition) { return {{"$ref", "#/definitions/" + definition}}; }

std::string component_definition(const Kind& kind, const std::string& component) { return kind.name() + "." + component; }

bool nothing_required(const Fields& fields) {
  return std::none_of(fields.all().begin(), fields.all().end(), [](const Field& f) { return f.mandatory; });
}

bool merged_by_name(const Shape& list) {
  const auto named = [](const Fields& entry) { return entry.find("name") || entry.find("between"); };
  if (list.form != Form::list) return false;
  return list.entry->form == Form::component ? merged_by_name(*list.entry->kind) : list.entry->form == Form::object && named(list.entry->prototype());
}

bool merged_by_name(const Kind& kind) {
  const auto& entries = kind.entries();
  return std::all_of(entries.begin(), entries.end(), [&](const auto& entry) {
    const Fields fields = kind.prototype(entry.first);
    return fields.find("name") != nullptr;
  });
}

json required_schema(const Fields& root, json& definitions) {
  json schema = Required(definitions).object(root);
  if (!schema.contains("required") || !root.find("name")) return schema;
  schema["if"] = {{"required", json::array({"name"})}};
  schema["then"] = {{"required", schema["required"]}};
  schema.erase("required");
  return schema;
}

}  // namespace tack
