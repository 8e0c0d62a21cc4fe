#include "framework/config/value.hpp"

#include <fmt/format.h>

#include <utility>

namespace tack {

std::string SourceMark::text() const {
  const std::string name = file ? *file : "(built in)";
  return line > 0 ? fmt::format("{}:{}:{}", name, line, column) : name;
}

Value Value::scalar(std::string text) {
  Value v;
  v.kind = Kind::scalar;
  v.text = std::move(text);
  return v;
}

Value Value::number(double value) { return scalar(fmt::format("{}", value)); }

Value Value::sequence() { return sequence(std::vector<Value>{}); }
Value Value::sequence(std::vector<Value> items) {
  Value v;
  v.kind = Kind::sequence;
  v.items = std::move(items);
  return v;
}

Value Value::map() {
  Value v;
  v.kind = Kind::map;
  return v;
}

const Value* Value::find(std::string_view key) const {
  for (const Entry& e : entries) {
    if (e.key == key) return &e.value;
  }
  return nullptr;
}

Value* Value::find(std::string_view key) {
  return const_cast<Value*>(std::as_const(*this).find(key));
}

Value& Value::set(std::string key, Value value) {
  if (Value* present = find(key)) return *present = std::move(value);
  SourceMark key_mark = value.mark;
  entries.push_back({std::move(key), std::move(key_mark), std::move(value)});
  return entries.back().value;
}

std::string Value::description() const {
  switch (kind) {
    case Kind::null:
      return "nothing";
    case Kind::scalar:
      return fmt::format("'{}'", text);
    case Kind::sequence:
      return fmt::format("a list of {}", items.size());
    case Kind::map:
      return "a map";
  }
  return "";
}

}  // namespace tack
