// Required keys of a file without includes, as a JSON schema of its own: mandatory keys, and `type`
// where a component is chosen. In a file with includes, any of these may be in an included file,
// and named list entries may be removed.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "framework/config/field.hpp"

namespace tack {

nlohmann::json schema_reference(const std::string& definition);
std::string component_definition(const Kind& kind, const std::string& component);

bool nothing_required(const Fields& fields);

// Returns true if merging finds the entries of a list by their names (merge.hpp).
bool merged_by_name(const Shape& list);
bool merged_by_name(const Kind& kind);  // for a list of components of this kind
inline constexpr std::array<std::pair<const char*, const char*>, 2> merging_flags{
    {{"remove", "removes the included entry of this name [true or false]"},
     {"replace", "replaces the included entry of this name instead of merging [true or false]"}}};

// Returns the schema and adds the definitions it refers to. A file without `name` is meant to be
// included: its top level requires no key.
nlohmann::json required_schema(const Fields& root, nlohmann::json& definitions);

}  // namespace tack
