// What has to be there in a file that includes no other, as a JSON schema of its own: keys that are required, and a `type` where a component
// is chosen. In one that does, any of it may come from there, and lists of named entries may take some out.
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

// Whether merging finds the entries of a list by their names (merge.hpp), and what such entries may also say.
bool merged_by_name(const Shape& list);
bool merged_by_name(const Kind& kind);  // whether it does in a list of these
inline constexpr std::array<std::pair<const char*, const char*>, 2> merging_flags{
    {{"remove", "removes the included entry of this name [true or false]"},
     {"replace", "replaces the included entry of this name instead of merging [true or false]"}}};

// Adds to `definitions` what it refers to. A file without a `name` is one for others to include: of its own keys none is required.
nlohmann::json required_schema(const Fields& root, nlohmann::json& definitions);

}  // namespace tack
