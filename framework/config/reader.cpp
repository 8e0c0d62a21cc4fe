// Reading of maps and components, and the collected errors; leaves are in reader_leaves.cpp.
#include "framework/config/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <tuple>

#include "framework/config/field.hpp"
#include "framework/config/nearest.hpp"
#include "framework/config/registry.hpp"
#include "framework/config/retired_keys.hpp"
#include "framework/config/units.hpp"
#include "framework/config/words.hpp"
#include "geometry/errors.hpp"

namespace tack {

namespace {

bool begins_number(const std::string& text) { return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])); }

// Returns a hint for a scalar in place of a map: "; write {mu: 0.5}" for a number, or a missing
// space after a key's colon; "" if neither applies.
std::string map_hint(const Value& value, const Fields& fields) {
  if (!value.is_scalar()) return "";
  const size_t colon = value.text.find(':');
  if (colon != std::string::npos && fields.find(value.text.substr(0, colon))) return fmt::format("; a space is missing after the colon of '{}:'", value.text.substr(0, colon));
  for (const Field& f : fields.all()) {
    if (f.shape.form != Shape::Form::number || !f.mandatory) continue;
    try {
      to_si(value.text, f.shape.unit);
      return fmt::format("; write {{{}: {}}}", f.key, value.text);
    } catch (const InputError&) {
    }
  }
  return "";
}

// Returns an expression for messages, with its parameters that have no unit: "'2 * width', where
// width has no unit".
std::string with_unitless_names(const std::string& expression, const Parameters& parameters) {
  const std::vector<std::string> names = parameters.unitless_in(expression);
  if (names.empty()) return fmt::format("'{}'", expression);
  return fmt::format("'{}', where {} {} no unit", expression, fmt::join(names, " and "), names.size() > 1 ? "have" : "has");
}

// Returns the entry of a field, under its present or a retired name; nullptr if there is none.
const Value::Entry* entry_of_field(const Value& map, const std::string& key, const Fields& fields) {
  const Value::Entry* entry = entry_of_key(map, key);
  return entry && field_of_key(fields, entry->key) == fields.find(key) ? entry : nullptr;
}

}  // namespace

void Reader::bind(const Value& value, Fields& fields, std::string_view context) {
  bind_map(value, fields, context, false);
}

void Reader::unknown_keys(const Value& map, const Fields& fields, std::string_view context,
                          bool typed) {
  std::vector<std::string> keys = fields.keys();
  if (typed) keys.push_back("type");
  std::sort(keys.begin(), keys.end());
  for (const Value::Entry& e : map.entries) {
    if (std::binary_search(keys.begin(), keys.end(), e.key)) continue;
    if (const Field* field = field_of_key(fields, e.key)) {  // by its retired name
      if (const Value::Entry* other = entry_of_key(map, field->key); other->key != e.key)
        error(e.mark, fmt::format("'{}' is now called '{}', and {} has that key as well; keep one of them", e.key, field->key, other->mark.text()));
      continue;
    }
    if ((e.key == "true" || e.key == "True") && std::binary_search(keys.begin(), keys.end(), "on")) {
      error(e.mark, fmt::format("unknown key '{}' in {}; did you mean 'on'? Libraries for YAML 1.1, such as PyYAML, take a bare `on` for true: "
                                "write it in quotes where they read it", e.key, context));
      continue;
    }
    if (e.value.is_null() && begins_number(e.key)) {  // {young: 0,1 MPa}
      error(e.mark, fmt::format("unknown key '{}' in {}; a comma ends a value; write numbers with a decimal point: 0.1", e.key, context));
      continue;
    }
    const size_t colon = e.key.find(':');
    if (e.value.is_null() && colon != std::string::npos && std::binary_search(keys.begin(), keys.end(), e.key.substr(0, colon))) {  // {distance:1 mm}
      error(e.mark, fmt::format("unknown key '{}' in {}; a space is missing after the colon of '{}:'", e.key, context, e.key.substr(0, colon)));
      continue;
    }
    error(e.mark,
          fmt::format("unknown key '{}' in {}{}", e.key, context, suggestion(e.key, keys, "keys")));
  }
}

void Reader::bind_map(const Value& map, Fields& fields, std::string_view context, bool typed) {
  if (map.is_scalar() && !fields.bare_key().empty()) {
    Value only = Value::map();
    only.mark = map.mark;
    only.set(fields.bare_key(), map);
    return bind_map(only, fields, context, typed);
  }
  if (!map.is_map() && !map.is_null()) {
    return error(map.mark, fmt::format("{} expects a {}map, got {}{}", context, fields.bare_key().empty() ? "" : "text or a ", map.description(), map_hint(map, fields)));
  }
  const std::size_t errors_before = errors_.size();
  unknown_keys(map, fields, context, typed);
  for (const Field& f : fields.all()) {
    const Value::Entry* entry = entry_of_field(map, f.key, fields);
    const Value* v = entry ? &entry->value : nullptr;
    const bool absent = !v || (v->is_null() && f.shape.nullable);
    if (f.mandatory && absent) {
      error(map.mark, fmt::format("missing key '{}' in {}: {}; expects {}", f.key, context, f.doc,
                                  f.shape.expectation()));
    } else if (v && parameters_.empty()) {
      f.read(*v, f, *this);
    } else if (v) {
      const std::size_t before = errors_.size();
      const Value resolved = f.variables ? with_numbers_in_formula(*v, map, f) : with_numbers(*v, f.shape, f.key);
      if (errors_.size() == before) f.read(resolved, f, *this);
    }
  }
  if (errors_.size() == errors_before) run_checks(map, fields);
}

// Returns the value with expressions of parameters replaced by numbers, wherever numbers are
// expected.
Value Reader::with_numbers(const Value& value, const Shape& shape, std::string_view key) {
  Value out = value;
  const auto each = [&](const Shape& inner) {
    for (Value& item : out.items) item = with_numbers(item, inner, key);
    for (Value::Entry& entry : out.entries) entry.value = with_numbers(entry.value, inner, key);
  };
  switch (shape.form) {
    case Shape::Form::list:
    case Shape::Form::map:
      if (shape.entry) each(*shape.entry);
      break;
    case Shape::Form::schedule:
      each(shape);
      [[fallthrough]];
    case Shape::Form::number:
    case Shape::Form::integer:
    case Shape::Form::any:
      if (!value.is_scalar() || !parameters_.named_in(value.text)) break;
      try {
        out.text = parameters_.evaluated(value.text);
        out.comment = with_unitless_names(value.text, parameters_);
      } catch (const InputError& e) {
        error(value.mark, fmt::format("{}: {}", key, e.what()));
      }
      break;
    default: break;
  }
  return out;
}

// Replaces scene parameters in a formula, except names in the formula's own `parameters`.
Value Reader::with_numbers_in_formula(const Value& value, const Value& map, const Field& field) {
  Value out = value;
  if (!value.is_scalar()) return out;
  try {
    out.text = parameters_.inserted(value.text, *field.variables, map.find("parameters"));
  } catch (const InputError& e) {
    error(value.mark, fmt::format("{}: {}", field.key, e.what()));
  }
  return out;
}

void Reader::run_checks(const Value& map, const Fields& fields) {
  for (const Fields::Check& check : fields.checks()) {
    const std::string wrong = check.condition();
    if (wrong.empty()) continue;
    const Value::Entry* entry = entry_of_field(map, check.key, fields);
    error(entry ? entry->value.mark : map.mark, fmt::format("{}: {}", check.key, wrong));
  }
}

std::unique_ptr<Component> Reader::component(const Value& value, const Kind& kind,
                                             Component* present, std::string_view key) {
  const Value* type = value.is_map() ? value.find("type") : &value;
  if (!type && present) {
    Fields fields = fields_of(*present);
    bind_map(value, fields, fmt::format("{} '{}'", kind.name(), present->type()), true);
    return nullptr;
  }
  if (!type || !type->is_scalar()) {
    error(type ? type->mark : value.mark,
          fmt::format("{}: expects 'type', the name of {} ({}), got {}", key, with_article(kind.name()),
                      fmt::join(kind.names(), ", "), type ? type->description() : "no 'type'"));
    return nullptr;
  }
  std::unique_ptr<Component> made;
  try {
    made = kind.entry(type->text).factory();
  } catch (const InputError& e) {
    error(type->mark, fmt::format("{}: {}", key, e.what()));
    return nullptr;
  }
  Fields fields = fields_of(*made);
  Value bare = Value::map();
  bare.mark = value.mark;
  bind_map(value.is_map() ? value : bare, fields, fmt::format("{} '{}'", kind.name(), type->text),
           true);
  return made;
}

void Reader::error(const SourceMark& mark, std::string_view message) {
  errors_.push_back({mark, std::string(message)});
}

void Reader::finish() const {
  constexpr std::size_t most = 20;
  if (errors_.empty()) return;
  const auto position = [](const Error& e) {
    return std::make_tuple(e.mark.file ? *e.mark.file : "", e.mark.line, e.mark.column);
  };
  std::vector<Error> sorted = errors_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Error& a, const Error& b) { return position(a) < position(b); });
  std::string text;
  for (std::size_t i = 0; i < std::min(most, sorted.size()); ++i) {
    text += fmt::format("{}{}: {}", i ? "\n" : "", sorted[i].mark.text(), sorted[i].message);
  }
  if (sorted.size() > most) text += fmt::format("\n... and {} more errors", sorted.size() - most);
  throw InputError(text);
}

std::string entry_context(std::string_view key, std::size_t index, const Value& entry) {
  const Value* name = entry.find("name");
  if (name && name->is_scalar()) return fmt::format("{} '{}'", key, name->text);
  return fmt::format("{}[{}]", key, index);
}

}  // namespace tack
