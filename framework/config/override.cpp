// Values at dotted paths, such as `--set a.b=c`: follows the path, creates missing keys and
// replaces the value at its end.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>

#include "framework/config/nearest.hpp"
#include "framework/config/parse.hpp"
#include "framework/config/retired_keys.hpp"
#include "framework/config/yaml_reader.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

void set_marks(Value& v, const SourceMark& mark) {
  v.mark = mark;
  for (Value& item : v.items) set_marks(item, mark);
  for (Value::Entry& e : v.entries) {
    e.mark = mark;
    set_marks(e.value, mark);
  }
}

std::vector<std::string> split_path(const std::string& path, const SourceMark& origin) {
  std::vector<std::string> segments;
  std::istringstream stream(path + ".");
  for (std::string segment; std::getline(stream, segment, '.');) segments.push_back(segment);
  if (std::find(segments.begin(), segments.end(), "") != segments.end()) {
    throw InputError(origin.text() + ": expects key=value or path.to.key=value");
  }
  return segments;
}

std::optional<std::size_t> as_index(const std::string& segment) {
  std::size_t index = 0;
  const char* end = segment.data() + segment.size();
  const auto [stop, status] = std::from_chars(segment.data(), end, index);
  return status == std::errc() && stop == end ? std::optional(index) : std::nullopt;
}

const std::string* own_name(const Value& item) {
  const Value* name = item.find("name");
  return name && name->is_scalar() ? &name->text : nullptr;
}

// Returns an entry by its index or name; nullptr if there is none.
const Value* entry_of(const Value& list, const std::string& segment) {
  if (const auto index = as_index(segment)) return *index < list.items.size() ? &list.items[*index] : nullptr;
  for (const Value& item : list.items)
    if (const std::string* name = own_name(item); name && *name == segment) return &item;
  return nullptr;
}

Value& in_list(Value& list, const std::string& segment, const SourceMark& origin) {
  if (const Value* entry = entry_of(list, segment)) return list.items[static_cast<std::size_t>(entry - list.items.data())];
  if (const auto index = as_index(segment))
    throw InputError(fmt::format("{}: there is no entry {}; the list has {}, counted from 0",
                                 origin.text(), *index, list.items.size()));
  std::vector<std::string> names;
  for (const Value& item : list.items)
    if (const std::string* name = own_name(item)) names.push_back(*name);
  throw InputError(fmt::format("{}: no list entry is named '{}'{}", origin.text(), segment,
                               suggestion(segment, names, "names")));
}

Value& in_map(Value& map, const std::string& key, const SourceMark& origin) {
  if (map.is_scalar()) {  // a component written as a bare name
    Value type = map;
    map = Value::map();
    map.mark = type.mark;
    map.set("type", std::move(type));
  }
  map.kind = Value::Kind::map;  // a null becomes a map
  if (Value::Entry* present = entry_of_key(map, key)) {
    if (present->key != key) present->mark = origin;  // a retired name of the key, or its present one
    present->key = key;
    return present->value;
  }
  Value created;
  created.mark = origin;
  return map.set(key, std::move(created));
}

// Returns the full path of a parameter given by its name alone, unless the name is a key.
std::string full_path(const Value& root, const std::string& path) {
  const Value* parameters = path.find('.') == path.npos && !root.find(path) ? root.find("parameters") : nullptr;
  return parameters && parameters->find(path) ? "parameters." + path : path;
}

}  // namespace

void apply_override(Value& root, const std::string& assignment) {
  const auto name = std::make_shared<const std::string>("--set " + assignment);
  const SourceMark origin{name, 0, 0};
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) {
    throw InputError(origin.text() + ": expects key=value or path.to.key=value");
  }
  const std::string text = assignment.substr(equals + 1);
  // A text that begins with # is a colour; in YAML it would be a comment.
  Value replacement = text.starts_with('#') ? Value::scalar(text) : read_yaml(text, *name);
  set_marks(replacement, origin);
  set_at(root, assignment.substr(0, equals), std::move(replacement));
}

Value with_overrides(Value root, const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments) apply_override(root, assignment);
  return root;
}

void set_at(Value& root, const std::string& path, Value value) {
  const SourceMark origin = value.mark;
  Value* node = &root;
  for (const std::string& segment : split_path(full_path(root, path), origin)) {
    node = node->is_sequence() ? &in_list(*node, segment, origin) : &in_map(*node, segment, origin);
  }
  *node = std::move(value);
}

const Value* value_at(const Value& root, const std::string& path) {
  const Value* node = &root;
  std::istringstream stream(full_path(root, path));
  for (std::string segment; node && std::getline(stream, segment, '.');) {
    const Value::Entry* entry = entry_of_key(*node, segment);
    node = node->is_sequence() ? entry_of(*node, segment) : entry ? &entry->value : nullptr;
  }
  return node;
}

}  // namespace tack
