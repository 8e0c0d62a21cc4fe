#include "framework/config/retired_keys.hpp"

#include <fmt/format.h>

#include <utility>

namespace tack {
namespace {

constexpr RetiredKey all_retired_keys[] = {
    {"between_held", "between_prescribed"},
    {"filling", "content"},
    {"guard", "safety_barrier"},
    {"max_halvings", "max_cutbacks"},
    {"push_out", "overclosure_adjustment"},
    {"servo", "position_motor"},
};

void add_texts(const Value& map, const Fields& fields, std::vector<std::string>& texts);

// Returns the name of the component that a map chooses by `type`, else that of the field's default.
std::string chosen_component(const Value& value, const Field& field) {
  const Value* type = value.find("type");
  const Value current = type || field.shape.form != Shape::Form::component ? Value() : field.write();
  if (!type) type = current.find("type");
  return type ? type->text : "";
}

void add_texts(const Value& value, const Shape& shape, const Field& field,
                  std::vector<std::string>& texts) {
  switch (shape.form) {
    case Shape::Form::list:
      for (const Value& item : value.items) add_texts(item, *shape.entry, field, texts);
      break;
    case Shape::Form::map:
      for (const Value::Entry& e : value.entries)
        add_texts(e.value, *shape.entry, field, texts);
      break;
    case Shape::Form::object:
      add_texts(value, shape.prototype(), texts);
      break;
    case Shape::Form::component:
      if (const std::string name = chosen_component(value, field); value.is_map() && !name.empty())
        add_texts(value, shape.kind->prototype(name), texts);
      break;
    default:
      break;
  }
}

void add_texts(const Value& map, const Fields& fields, std::vector<std::string>& texts) {
  for (const Value::Entry& e : map.entries) {
    const Field* field = field_of_key(fields, e.key);
    if (!field) continue;
    if (field->key != e.key)
      texts.push_back(
          fmt::format("{}: '{}' is now called '{}'", e.mark.text(), e.key, field->key));
    if (!field->instead.empty())
      texts.push_back(fmt::format("{}: '{}' is deprecated: {}", e.mark.text(), e.key, field->instead));
    add_texts(e.value, field->shape, *field, texts);
  }
}

}  // namespace

std::span<const RetiredKey> retired_keys() { return all_retired_keys; }

std::string_view present_key(std::string_view key) {
  for (const RetiredKey& k : all_retired_keys)
    if (k.retired == key) return k.present;
  return key;
}

std::vector<std::string> retired_names(const Field& field, const Fields& fields) {
  std::vector<std::string> names;
  for (const RetiredKey& k : all_retired_keys)
    if (k.present == field.key && !fields.find(k.retired)) names.emplace_back(k.retired);
  return names;
}

const Field* field_of_key(const Fields& fields, std::string_view key) {
  const Field* field = fields.find(key);
  return field ? field : fields.find(present_key(key));
}

const Value::Entry* entry_of_key(const Value& map, std::string_view key) {
  const Value::Entry* renamed = nullptr;
  for (const Value::Entry& e : map.entries) {
    if (e.key == key) return &e;
    if (present_key(e.key) == present_key(key)) renamed = &e;
  }
  return renamed;
}

Value::Entry* entry_of_key(Value& map, std::string_view key) {
  return const_cast<Value::Entry*>(entry_of_key(std::as_const(map), key));
}

std::vector<std::string> retired_key_texts(const Value& scene, const Fields& fields) {
  std::vector<std::string> texts;
  add_texts(scene, fields, texts);
  return texts;
}

}  // namespace tack
