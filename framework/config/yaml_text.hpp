// Writes a Value tree as YAML text that reads back as the same tree, without marks and comments.
#pragma once

#include <string>

#include "framework/config/value.hpp"

namespace tack {

// Returns block style with lists of plain values in one line and comments after values. Ends with a
// newline.
std::string yaml_text(const Value& value);

// Returns one line: "[0, 0, 1]", "{type: cholmod}".
std::string inline_text(const Value& value);

}  // namespace tack
