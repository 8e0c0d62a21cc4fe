// Notes of an operation on a mesh: a line each, without a newline. A warning begins with "warning:
// ".
#pragma once

#include <string>
#include <vector>

namespace tack {

using Notes = std::vector<std::string>;

}  // namespace tack
