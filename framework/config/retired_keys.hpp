// Keys that have been renamed. A scene may still use the retired name of a key: it is read as the
// present name, with a warning. Both names in one map are an error (reader.cpp). Schema and
// reference list retired names as deprecated; resolved scenes use present names.
//
// A retired name stands for its present name in every map that has a field of the present name,
// unless the map has a field of the retired name itself.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "framework/config/field.hpp"
#include "framework/config/value.hpp"

namespace tack {

struct RetiredKey {
  std::string_view retired, present;
};

// Returns all retired keys.
std::span<const RetiredKey> retired_keys();

// Returns the present name of a key; the key itself if it is not retired.
std::string_view present_key(std::string_view key);

// Returns the retired names under which a map of these fields may have a field.
std::vector<std::string> retired_names(const Field& field, const Fields& fields);

// Returns the field of a key or of its present name; nullptr if there is none.
const Field* field_of_key(const Fields& fields, std::string_view key);

// Returns the entry of a key: under this name, else under its present or a retired name; nullptr if
// there is none.
const Value::Entry* entry_of_key(const Value& map, std::string_view key);
Value::Entry* entry_of_key(Value& map, std::string_view key);

// Returns one line per retired key of a scene: "scene.yaml:3:8: 'guard' is now called
// 'safety_barrier'", and per key of a deprecated field. `fields`: those that the scene binds to.
std::vector<std::string> retired_key_texts(const Value& scene, const Fields& fields);

}  // namespace tack
