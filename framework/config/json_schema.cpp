// The JSON schema (draft 7): strict objects, with components as definitions chosen by `type`. A
// file with includes may give any subset of keys, so required keys are a schema of their own
// (schema_required.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "framework/config/describe.hpp"
#include "framework/config/retired_keys.hpp"
#include "framework/config/schema_numbers.hpp"
#include "framework/config/schema_required.hpp"
#include "framework/config/words.hpp"

namespace tack {
namespace {

using nlohmann::json;
using Form = Shape::Form;

json typed_value(const Value& v, const Shape& shape) {
  if (v.is_sequence()) {
    json list = json::array();
    for (const Value& item : v.items) {
      list.push_back(typed_value(item, shape.entry ? *shape.entry : shape));
    }
    return list;
  }
  if (shape.form == Form::flag) return v.text == "true";
  if (shape.form == Form::integer) return std::stoi(v.text);
  double number = 0;
  const bool numeric = shape.form == Form::number || shape.form == Form::schedule;
  if (numeric) std::from_chars(v.text.data(), v.text.data() + v.text.size(), number);
  return numeric ? json(number) : json(v.text);
}

class Schema {
 public:
  // Accepts expressions in place of numbers if `root` has `parameters`.
  explicit Schema(const Fields& root) : expressions_(root.find("parameters") != nullptr) {}
  json object(const Fields& fields) {
    json properties = json::object();
    for (const Field& f : fields.all()) {
      properties[f.key] = property(f);
      if (!f.instead.empty()) properties[f.key]["deprecated"] = true;
      for (const std::string& name : retired_names(f, fields)) {
        json& deprecated = properties[name] = properties[f.key];
        deprecated["deprecated"] = true;
        deprecated["description"] = fmt::format("Deprecated: now called '{}'.", f.key);
      }
    }
    return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  }

  json take_definitions() { return std::move(definitions_); }

 private:
  json property(const Field& f) {
    json schema = value(f.shape, f.bounds, f);
    if (f.shape.nullable && f.shape.form != Form::any) {
      schema = {{"anyOf", {schema, {{"type", "null"}}}}};
    }
    if (schema.contains("$ref"))
      schema = {{"allOf", json::array({schema})}};  // draft 7 ignores a $ref's siblings
    if (f.filled) schema["minItems"] = 1;
    schema["description"] = description(f);
    const Shape& leaf = f.shape.entry ? *f.shape.entry : f.shape;
    const bool has_default = !f.mandatory && f.shape.form != Form::map && leaf.form != Form::object &&
                             leaf.form != Form::component && leaf.form != Form::any;
    const Value v = has_default ? f.write() : Value();
    if (!v.is_null()) schema["default"] = typed_value(v, f.shape);
    return schema;
  }

  static std::string description(const Field& f) {
    std::string text = f.doc + " [" + f.shape.noun();
    if (!f.constraint().empty()) text += ", " + f.constraint();
    text += "]";
    for (const Shape::Option& o : f.shape.options) text += fmt::format("\n{}: {}", o.name, o.doc);
    return text;
  }

  json value(const Shape& shape, const Bounds& bounds, const Field& f) {
    switch (shape.form) {
      case Form::number:
        return number(shape.unit, bounds);
      case Form::integer:
        return bounded(expressions_ ? json{{"type", {"integer", "string"}}, {"pattern", expression_pattern}} : json{{"type", "integer"}}, bounds);
      case Form::flag:
        return {{"type", "boolean"}};
      case Form::text:
      case Form::path:
        return {{"type", {"string", "number", "boolean"}}};
      case Form::choice:
        return choice(shape);
      case Form::schedule:
        return schedule(shape.unit, bounds);
      case Form::list:
        return list(shape, bounds, f);
      case Form::map:
        return {{"type", "object"}, {"additionalProperties", value(*shape.entry, bounds, f)}};
      case Form::object:
        return struct_or_text(shape.prototype());
      case Form::component:
        define(*shape.kind);
        return schema_reference(shape.kind->name());
      case Form::any:
        return json::object();
    }
    return json::object();
  }

  json struct_or_text(const Fields& fields) {
    json all = object(fields);
    if (fields.bare_key().empty()) return all;
    const Field& bare = *fields.find(fields.bare_key());
    return {{"anyOf", json::array({value(bare.shape, bare.bounds, bare), all})}};
  }

  static json bounded(json schema, const Bounds& b) {
    if (b.low) schema[b.low_open ? "exclusiveMinimum" : "minimum"] = *b.low;
    if (b.high) schema[b.high_open ? "exclusiveMaximum" : "maximum"] = *b.high;
    return schema;
  }

  // Bounds apply to numbers only, the definition's patterns to texts only.
  json number(const Unit& unit, const Bounds& b) {
    const json kind = schema_reference(define_number(unit));
    return b.low || b.high ? bounded({{"allOf", json::array({kind})}}, b) : kind;
  }

  std::string define_number(const Unit& unit) {
    std::string name = fmt::format("number.{}", unit.quantity);
    std::replace(name.begin(), name.end(), ' ', '_');
    if (definitions_.contains(name)) return name;
    json schema{{"type", {"number", "string"}}, {"pattern", expressions_ ? fmt::format("{}|{}", number_pattern, expression_pattern) : number_pattern}};
    if (!unit.si.empty()) {
      definitions_["number.in_a_known_unit"] = {{"pattern", known_unit_pattern()}};
      schema["if"] = schema_reference("number.in_a_known_unit");
      schema["then"] = {{"pattern", unit_pattern(unit)}};
    }
    definitions_[name] = schema;
    return name;
  }

  static json choice(const Shape& shape) {
    json names = json::array();
    for (const Shape::Option& o : shape.options) names.push_back(o.name);
    return {{"enum", names}};
  }

  json schedule(const Unit& unit, const Bounds& b) {
    const json pair{{"type", "array"},
                    {"items", json::array({number(units::time, {}), number(unit, b)})},
                    {"additionalItems", false},
                    {"minItems", 2}};
    const json pairs{{"type", "array"}, {"items", pair}, {"minItems", 1}};
    return {{"anyOf", json::array({number(unit, b), pairs})}};
  }

  static void add_merging_flags(json& entry) {
    for (const auto& [key, doc] : merging_flags) entry["properties"][key] = {{"type", "boolean"}, {"description", doc}};
  }

  json list(const Shape& shape, const Bounds& bounds, const Field& f) {
    json entry = value(*shape.entry, bounds, f);
    if (shape.entry->form == Form::object && merged_by_name(shape)) add_merging_flags(entry);
    json schema{{"type", "array"}, {"items", std::move(entry)}};
    if (shape.count >= 0) schema["minItems"] = schema["maxItems"] = shape.count;
    return schema;
  }

  void define(const Kind& kind) {
    if (definitions_.contains(kind.name())) return;
    // Guards against recursion: components may contain components of their own kind.
    definitions_[kind.name()] = nullptr;
    json bare_names = json::array();
    json variants = json::array();
    for (const auto& [name, entry] : kind.entries()) {
      const Fields fields = kind.prototype(name);
      if (nothing_required(fields)) bare_names.push_back(name);
      json schema = object(fields);
      schema["description"] = entry.doc;
      schema["properties"]["type"] = {{"const", name}};
      if (merged_by_name(kind)) add_merging_flags(schema);
      definitions_[component_definition(kind, name)] = schema;
      variants.push_back(schema_reference(component_definition(kind, name)));
    }
    if (!bare_names.empty()) variants.push_back({{"enum", bare_names}});
    if (variants.empty()) variants.push_back(false);  // nothing of this kind is registered
    definitions_[kind.name()] = {{"description", kind.doc()}, {"anyOf", variants}};
  }

  const bool expressions_;
  json definitions_ = json::object();
};

}  // namespace

std::string json_schema(const Fields& root, const std::string& title) {
  Schema builder(root);
  json schema = builder.object(root);
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = title;
  const json text{{"type", "string"}};
  const json texts{{"type", "array"}, {"items", text}};
  schema["properties"]["include"] = {{"description", "Files merged under this one, lists of named entries by name."},
                                     {"anyOf", json::array({text, texts})}};
  schema["definitions"] = builder.take_definitions();
  schema["if"] = {{"required", json::array({"include"})}};
  schema["else"] = required_schema(root, schema["definitions"]);
  return schema.dump(1);
}

}  // namespace tack
