#include "framework/config/merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "framework/config/nearest.hpp"
#include "framework/config/retired_keys.hpp"
#include "framework/config/yaml_text.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

bool different_types(const Value& a, const Value& b) {
  const Value* type_a = a.find("type");
  const Value* type_b = b.find("type");
  return type_a && type_b && type_a->text != type_b->text;
}

// Returns one side of a pair: "cube", or "cube {type: tag, name: top}" for a region.
std::string end_of(const Value& end) {
  const Value* object = end.find("object");
  const Value* select = end.find("select");
  return (object ? object->text : end.text) + (select ? " " + inline_text(*select) : "");
}

// Returns the key of an entry: "cube", or "cube - wall" for a pair; nothing without one.
std::optional<std::string> name_of(const Value& entry) {
  const Value* name = entry.find("name");
  if (name && name->is_scalar()) return name->text;
  const Value* between = entry.find("between");
  if (!between || between->items.size() != 2) return std::nullopt;
  const std::string first = end_of(between->items[0]), second = end_of(between->items[1]);
  const auto& [a, b] = std::minmax(first, second);
  return a + " - " + b;
}

bool all_named(const Value& list) {
  return list.is_sequence() && !list.items.empty() &&
         std::all_of(list.items.begin(), list.items.end(), [](const Value& v) { return name_of(v).has_value(); });
}

Value* entry_named(Value& list, const std::string& name) {
  for (Value& entry : list.items)
    if (name_of(entry) == name) return &entry;
  return nullptr;
}

// Removes the key from the entry. Returns true if its value was `true`.
bool take_flag(Value& entry, const char* key) {
  const auto at = std::find_if(entry.entries.begin(), entry.entries.end(),
                               [&](const Value::Entry& e) { return e.key == key; });
  if (at == entry.entries.end()) return false;
  if (!at->value.is_scalar() || (at->value.text != "true" && at->value.text != "false"))
    throw InputError(fmt::format("{}: {}: expects true or false, got {}", at->value.mark.text(), key,
                                 at->value.description()));
  const bool flag = at->value.text == "true";
  entry.entries.erase(at);
  return flag;
}

void refuse_twice(Value& list) {
  for (Value& entry : list.items)
    if (entry_named(list, *name_of(entry)) != &entry)
      throw InputError(fmt::format("{}: '{}' is given twice in a list that is merged by names", entry.mark.text(),
                                   *name_of(entry)));
}

InputError nothing_to(const char* what, const Value& entry, const Value& base) {
  std::vector<std::string> names;
  for (const Value& v : base.items) names.push_back(*name_of(v));
  return InputError(fmt::format("{}: there is no '{}' to {}{}", entry.mark.text(), *name_of(entry), what,
                                suggestion(*name_of(entry), names, "names")));
}

void merge_named(Value& base, Value over) {
  refuse_twice(base);
  refuse_twice(over);
  for (Value& entry : over.items) {
    const bool remove = take_flag(entry, "remove"), replace = take_flag(entry, "replace");
    Value* present = entry_named(base, *name_of(entry));
    if ((remove || replace) && !present) throw nothing_to(remove ? "remove" : "replace", entry, base);
    if (remove) {
      base.items.erase(base.items.begin() + (present - base.items.data()));
    } else if (replace) {
      *present = std::move(entry);
    } else if (present) {
      merge(*present, std::move(entry));
    } else {
      base.items.push_back(std::move(entry));
    }
  }
  base.mark = over.mark;
}

// Returns the entry of `base` that a key of `over` overrides: under the same name, or under another
// name of a renamed key, unless `over` has that name as well.
Value::Entry* entry_over(Value& base, const Value& over, const std::string& key) {
  Value::Entry* present = entry_of_key(base, key);
  return present && present->key != key && over.find(present->key) ? nullptr : present;
}

}  // namespace

void merge(Value& base, Value over) {
  if (all_named(base) && all_named(over)) return merge_named(base, std::move(over));
  if (!base.is_map() || !over.is_map() || different_types(base, over)) {
    base = std::move(over);
    return;
  }
  base.mark = over.mark;
  for (Value::Entry& e : over.entries) {
    if (Value::Entry* present = entry_over(base, over, e.key)) {
      if (present->key != e.key) present->mark = e.mark;
      present->key = e.key;
      merge(present->value, std::move(e.value));
    } else {
      base.entries.push_back({e.key, e.mark, std::move(e.value)});  // entry_over needs the keys
    }
  }
}

}  // namespace tack
