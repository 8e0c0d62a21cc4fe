// `--set a.b=c`, and values for keys from elsewhere: walks the dotted path, creating what is missing, and replaces the value there.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "framework/config/nearest.hpp"
#include "framework/config/parse.hpp"
#include "framework/config/yaml_reader.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

void place_marks(Value& v, const SourceMark& mark) {
  v.mark = mark;
  for (Value& item : v.items) place_marks(item, mark);
  for (Value::Entry& e : v.entries) {
    e.mark = mark;
    place_marks(e.value, mark);
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

Value& by_index(Value& list, std::size_t index, const SourceMark& origin) {
  if (index < list.items.size()) return list.items[index];
  throw InputError(fmt::format("{}: there is no entry {}; the list has {}, counted from 0",
                               origin.text(), index, list.items.size()));
}

Value& by_name(Value& list, const std::string& name, const SourceMark& origin) {
  std::vector<std::string> names;
  for (Value& item : list.items) {
    const Value* item_name = item.find("name");
    if (!item_name || !item_name->is_scalar()) continue;
    if (item_name->text == name) return item;
    names.push_back(item_name->text);
  }
  throw InputError(fmt::format("{}: no list entry is named '{}'{}", origin.text(), name,
                               suggestion(name, names, "names")));
}

Value& in_list(Value& list, const std::string& segment, const SourceMark& origin) {
  std::size_t index = 0;
  const char* end = segment.data() + segment.size();
  const auto [stop, status] = std::from_chars(segment.data(), end, index);
  const bool is_index = status == std::errc() && stop == end;
  return is_index ? by_index(list, index, origin) : by_name(list, segment, origin);
}

Value& in_map(Value& map, const std::string& key, const SourceMark& origin) {
  if (map.is_scalar()) {  // a component written as a bare name
    Value type = map;
    map = Value::map();
    map.mark = type.mark;
    map.set("type", std::move(type));
  }
  map.kind = Value::Kind::map;  // a null becomes a map
  if (Value* present = map.find(key)) return *present;
  Value created;
  created.mark = origin;
  return map.set(key, std::move(created));
}

}  // namespace

void apply_override(Value& root, const std::string& assignment) {
  const auto name = std::make_shared<const std::string>("--set " + assignment);
  const SourceMark origin{name, 0, 0};
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) {
    throw InputError(origin.text() + ": expects key=value or path.to.key=value");
  }
  Value replacement = read_yaml(assignment.substr(equals + 1), *name);
  place_marks(replacement, origin);
  set_at(root, assignment.substr(0, equals), std::move(replacement));
}

void set_at(Value& root, const std::string& path, Value value) {
  const SourceMark origin = value.mark;
  Value* node = &root;
  for (const std::string& segment : split_path(path, origin)) {
    node = node->is_sequence() ? &in_list(*node, segment, origin) : &in_map(*node, segment, origin);
  }
  *node = std::move(value);
}

const Value* value_at(const Value& root, const std::string& path) {
  const Value* node = &root;
  std::istringstream stream(path);
  for (std::string segment; node && std::getline(stream, segment, '.');) {
    if (!node->is_sequence()) {
      node = node->find(segment);
      continue;
    }
    const Value* entry = nullptr;
    for (size_t i = 0; i < node->items.size() && !entry; ++i) {
      const Value* name = node->items[i].find("name");
      if (segment == std::to_string(i) || (name && name->is_scalar() && name->text == segment)) entry = &node->items[i];
    }
    node = entry;
  }
  return node;
}

}  // namespace tack
