// YAML text to a Value tree. Errors (syntax, duplicate keys, tags, several documents) are
// InputErrors that open with file:line:column. Anchors and aliases are expanded by copying.
#pragma once

#include <string>

#include "framework/config/value.hpp"

namespace tack {

// `name` stands for the file in marks and messages.
Value read_yaml(const std::string& text, const std::string& name);

}  // namespace tack
