// Checks a document against the part of JSON schema (draft 7) that tack writes. Any other keyword
// is an error, so that a schema which says more than this understands cannot pass unnoticed.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>
#include <string>

namespace tack::toy {

class SchemaCheck {
 public:
  using json = nlohmann::json;

  explicit SchemaCheck(const json& root) : root_(root) {}

  bool accepts(const json& value) const { return fits(root_, value); }

 private:
  bool fits(const json& schema, const json& value) const {
    if (schema.is_boolean()) return schema.get<bool>();
    if (schema.contains("$ref")) {
      return fits(root_.at(json::json_pointer(schema["$ref"].get<std::string>().substr(1))), value);
    }
    if (schema.contains("if")) {
      const char* branch = fits(schema["if"], value) ? "then" : "else";
      if (schema.contains(branch) && !fits(schema[branch], value)) return false;
    }
    return std::all_of(schema.items().begin(), schema.items().end(), [&](const auto& rule) {
      return obeys(rule.key(), rule.value(), schema, value);
    });
  }

  bool obeys(const std::string& word, const json& rule, const json& schema, const json& v) const {
    for (const char* note : {"$schema", "title", "description", "default", "definitions",
                             "$comment", "deprecated", "if", "then", "else"}) {
      if (word == note) return true;
    }
    if (word == "type") return rule.is_array() ? any_type(rule, v) : is_type(rule, v);
    if (word == "const") return v == rule;
    if (word == "enum") return std::find(rule.begin(), rule.end(), v) != rule.end();
    if (word == "anyOf") return matches(rule, v) > 0;
    if (word == "oneOf") return matches(rule, v) == 1;
    if (word == "allOf") return matches(rule, v) == rule.size();
    if (v.is_number()) return number_obeys(word, rule, v.get<double>());
    if (word == "pattern")
      return !v.is_string() ||
             std::regex_search(v.get<std::string>(), std::regex(rule.get<std::string>()));
    if (v.is_array()) return array_obeys(word, rule, schema, v);
    if (v.is_object()) return object_obeys(word, rule, schema, v);
    return known(word);
  }

  std::size_t matches(const json& schemas, const json& v) const {
    return static_cast<std::size_t>(std::count_if(
        schemas.begin(), schemas.end(), [&](const json& schema) { return fits(schema, v); }));
  }

  static bool is_type(const std::string& type, const json& v) {
    if (type == "number") return v.is_number();
    if (type == "integer") return v.is_number_integer();
    return v.type_name() == type;
  }

  static bool any_type(const json& types, const json& v) {
    return std::any_of(types.begin(), types.end(), [&](const json& t) { return is_type(t, v); });
  }

  static bool number_obeys(const std::string& word, const json& rule, double v) {
    if (word == "minimum") return v >= rule.get<double>();
    if (word == "maximum") return v <= rule.get<double>();
    if (word == "exclusiveMinimum") return v > rule.get<double>();
    if (word == "exclusiveMaximum") return v < rule.get<double>();
    return known(word);
  }

  bool array_obeys(const std::string& word, const json& rule, const json& schema,
                   const json& v) const {
    if (word == "minItems") return v.size() >= rule.get<std::size_t>();
    if (word == "maxItems") return v.size() <= rule.get<std::size_t>();
    if (word == "additionalItems") return v.size() <= schema["items"].size();
    if (word != "items") return known(word);
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (rule.is_array() && i >= rule.size()) break;
      if (!fits(rule.is_array() ? rule[i] : rule, v[i])) return false;
    }
    return true;
  }

  bool object_obeys(const std::string& word, const json& rule, const json& schema,
                    const json& v) const {
    const auto has = [&](const json& key) { return v.contains(key.get<std::string>()); };
    if (word == "required") return std::all_of(rule.begin(), rule.end(), has);
    const json listed = schema.value("properties", json::object());
    for (const auto& [key, value] : v.items()) {
      if (word == "properties" && rule.contains(key) && !fits(rule[key], value)) return false;
      if (word == "additionalProperties" && !listed.contains(key) && !fits(rule, value))
        return false;
    }
    return known(word);
  }

  static bool known(const std::string& word) {
    for (const char* k : {"minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum", "pattern",
                          "items", "minItems", "maxItems", "additionalItems", "required",
                          "properties", "additionalProperties"}) {
      if (word == k) return true;
    }
    throw std::logic_error("this check does not know the schema keyword " + word);
  }

  const json& root_;
};

}  // namespace tack::toy
