// The JSON schema (draft 7): strict objects, components as definitions chosen by `type`.
#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>

#include "framework/config/describe.hpp"
#include "framework/config/words.hpp"

namespace tack {
namespace {

using nlohmann::json;
using Form = Shape::Form;

// A number, which may be followed by a unit; the program itself checks the unit.
constexpr const char* number_pattern =
    R"(^\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?\s*([A-Za-z%µ°1/(].*)?$)";

std::string definition_name(const Kind& kind, const std::string& component) {
  return kind.name() + "." + component;
}

json reference(const std::string& definition) { return {{"$ref", "#/definitions/" + definition}}; }

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
  json object(const Fields& fields) {
    json properties = json::object();
    json required = json::array();
    for (const Field& f : fields.all()) {
      properties[f.key] = property(f);
      if (f.mandatory) required.push_back(f.key);
    }
    json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
    if (!required.empty()) schema["required"] = required;
    return schema;
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
    const bool has_default = !f.mandatory && leaf.form != Form::object &&
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
        return number(bounds);
      case Form::integer:
        return bounded({{"type", "integer"}}, bounds);
      case Form::flag:
        return {{"type", "boolean"}};
      case Form::text:
      case Form::path:
        return {{"type", {"string", "number", "boolean"}}};
      case Form::choice:
        return choice(shape);
      case Form::schedule:
        return schedule(bounds);
      case Form::list:
        return list(shape, bounds, f);
      case Form::map:
        return {{"type", "object"}, {"additionalProperties", value(*shape.entry, bounds, f)}};
      case Form::object:
        return object(shape.prototype());
      case Form::component:
        return component(shape, f);
      case Form::any:
        return json::object();
    }
    return json::object();
  }

  static json bounded(json schema, const Bounds& b) {
    if (b.low) schema[b.low_open ? "exclusiveMinimum" : "minimum"] = *b.low;
    if (b.high) schema[b.high_open ? "exclusiveMaximum" : "maximum"] = *b.high;
    return schema;
  }

  // The bounds only bind numbers, the pattern only texts.
  static json number(const Bounds& b) {
    return bounded({{"type", {"number", "string"}}, {"pattern", number_pattern}}, b);
  }

  static json choice(const Shape& shape) {
    json names = json::array();
    for (const Shape::Option& o : shape.options) names.push_back(o.name);
    return {{"enum", names}};
  }

  static json schedule(const Bounds& b) {
    const json pair{{"type", "array"},
                    {"items", json::array({number({}), number(b)})},
                    {"additionalItems", false},
                    {"minItems", 2}};
    const json pairs{{"type", "array"}, {"items", pair}, {"minItems", 1}};
    return {{"anyOf", json::array({number(b), pairs})}};
  }

  json list(const Shape& shape, const Bounds& bounds, const Field& f) {
    json schema{{"type", "array"}, {"items", value(*shape.entry, bounds, f)}};
    if (shape.count >= 0) schema["minItems"] = schema["maxItems"] = shape.count;
    return schema;
  }

  // With a default component, a map without `type` sets the default's parameters.
  json component(const Shape& shape, const Field& f) {
    define(*shape.kind);
    json chosen = reference(shape.kind->name());
    if (f.shape.form != Form::component) return chosen;
    const Value current = f.write();
    const Value* type = current.find("type");
    if (!type || type->text.empty()) return chosen;
    return {{"anyOf", {chosen, reference(definition_name(*shape.kind, type->text))}}};
  }

  void define(const Kind& kind) {
    if (definitions_.contains(kind.name())) return;
    definitions_[kind.name()] = nullptr;  // components may contain components of their own kind
    json bare_names = json::array();
    json variants = json::array();
    for (const auto& [name, entry] : kind.entries()) {
      json schema = object(kind.prototype(name));
      if (!schema.contains("required")) bare_names.push_back(name);
      schema["description"] = entry.doc;
      schema["properties"]["type"] = {{"const", name}};
      definitions_[definition_name(kind, name)] = schema;
      const json typed{{"required", json::array({"type"})}};
      variants.push_back({{"allOf", {reference(definition_name(kind, name)), typed}}});
    }
    if (!bare_names.empty()) variants.push_back({{"enum", bare_names}});
    if (variants.empty()) variants.push_back(false);  // nothing of this kind is registered
    definitions_[kind.name()] = {{"description", kind.doc()}, {"oneOf", variants}};
  }

  json definitions_ = json::object();
};

}  // namespace

std::string json_schema(const Fields& root, const std::string& title) {
  Schema builder;
  json schema = builder.object(root);
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = title;
  const json text{{"type", "string"}};
  const json texts{{"type", "array"}, {"items", text}};
  schema["properties"]["include"] = {{"description", "Files merged under this one, lists of named entries by name."},
                                     {"anyOf", json::array({text, texts})}};
  if (schema.contains("required")) {  // an included file may give what is required
    json given{{"required", schema["required"]}};
    schema["anyOf"] = json::array({given, {{"required", json::array({"include"})}}});
    schema.erase("required");
  }
  schema["definitions"] = builder.take_definitions();
  return schema.dump(1);
}

}  // namespace tack
