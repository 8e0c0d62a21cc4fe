// Field modifiers and storage of Fields; declarations of plain kinds are in field_kinds.cpp.
#include "framework/config/field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace tack {
namespace {

bool is_snake_case(const std::string& key) {
  const auto allowed = [](unsigned char c) {
    return std::islower(c) || std::isdigit(c) || c == '_';
  };
  return !key.empty() && std::all_of(key.begin(), key.end(), allowed);
}

}  // namespace

Field& Field::required() {
  mandatory = true;
  return *this;
}

Field& Field::nonempty() {
  filled = true;
  return *this;
}

Field& Field::formula(std::vector<std::string> of) {
  variables = std::move(of);
  return *this;
}

Field& Field::deprecated(std::string text) {
  instead = std::move(text);
  return *this;
}

Field& Field::line() {
  one_line = true;
  return *this;
}

Field& Field::positive() { return above(0); }

Field& Field::nonnegative() { return at_least(0); }

Field& Field::range(double low, double high) { return at_least(low).at_most(high); }

Field& Field::at_least(double low) {
  bounds.low = low;
  bounds.low_open = false;
  return *this;
}

Field& Field::at_most(double high) {
  bounds.high = high;
  bounds.high_open = false;
  return *this;
}

Field& Field::above(double low) {
  bounds.low = low;
  bounds.low_open = true;
  return *this;
}

Field& Field::below(double high) {
  bounds.high = high;
  bounds.high_open = true;
  return *this;
}

std::string Field::constraint() const {
  std::string range = bounds.text();
  if (!filled) return range;
  return range.empty() ? "not empty" : "not empty, " + range;
}

void Fields::check(std::string key, std::function<std::string()> condition) {
  checks_.push_back({std::move(key), std::move(condition)});
}

std::vector<std::string> Fields::keys() const {
  std::vector<std::string> keys;
  for (const Field& f : fields_) keys.push_back(f.key);
  return keys;
}

const Field* Fields::find(std::string_view key) const& {
  for (const Field& f : fields_) {
    if (f.key == key) return &f;
  }
  return nullptr;
}

Field& Fields::add(std::string key, std::string doc, Shape shape, decltype(Field::read) read,
                   decltype(Field::write) write) {
  if (find(key)) throw std::logic_error(fmt::format("field '{}' is declared twice", key));
  if (!is_snake_case(key) || key == "type" || key == "include") {
    throw std::logic_error(fmt::format("'{}' cannot be the key of a field", key));
  }
  if (doc.empty()) throw std::logic_error(fmt::format("field '{}' needs a description", key));
  Field f;
  f.key = std::move(key);
  f.doc = std::move(doc);
  f.shape = std::move(shape);
  f.read = std::move(read);
  f.write = std::move(write);
  fields_.push_back(std::move(f));
  return fields_.back();
}

namespace {

// Returns the unit of a value written in SI; a schedule has times as well.
std::string unit_comment(const Shape& shape) {
  if (shape.form == Shape::Form::schedule) return fmt::format("[s, {}]", shape.unit.si);
  return shape.unit.plain() ? "" : std::string(shape.unit.si);
}

}  // namespace

Value to_value(const Fields& fields) {
  Value map = Value::map();
  for (const Field& f : fields.all()) {
    if (!f.instead.empty()) continue;
    Value v = f.write();
    if (!v.is_map()) v.comment = unit_comment(f.shape);
    map.set(f.key, std::move(v));
  }
  const auto given = std::count_if(map.entries.begin(), map.entries.end(), [](const Value::Entry& e) { return !e.value.is_null(); });
  if (const Value* bare = fields.bare_key().empty() ? nullptr : map.find(fields.bare_key()); bare && given == 1 && !bare->is_null()) return *bare;
  return map;
}

Value to_value(const Component* component) {
  if (!component) return {};
  Value map = Value::map();
  map.set("type", Value::scalar(std::string(component->type())));
  for (Value::Entry& e : to_value(fields_of(*component)).entries) map.entries.push_back(e);
  return map;
}

}  // namespace tack
