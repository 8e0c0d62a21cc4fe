// Reads YAML text into a Value tree. Errors (syntax, duplicate keys, tags, several documents) are
// InputErrors that open with file:line:column. Anchors and aliases are expanded by copying.
#pragma once

#include <cstddef>
#include <string>

#include "framework/config/value.hpp"

namespace tack {

// name: stands for the file in marks and messages.
Value read_yaml(const std::string& text, const std::string& name);

// Returns the number of nodes of a tree, itself included.
std::size_t count_values(const Value& v);

}  // namespace tack
