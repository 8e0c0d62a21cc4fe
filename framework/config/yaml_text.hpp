// A Value tree as YAML text that reads back as the same tree (apart from marks and comments).
#pragma once

#include <string>

#include "framework/config/value.hpp"

namespace tack {

// Block style, lists of plain values in one line, comments behind values. Ends with a newline.
std::string yaml_text(const Value& value);

// One line: "[0, 0, 1]", "{type: cholmod}".
std::string inline_text(const Value& value);

}  // namespace tack
