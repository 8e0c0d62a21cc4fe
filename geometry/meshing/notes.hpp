// Notes of a mesh operation: one line each, without newline. A note that begins with "warning: " is
// a warning (mesh_warnings.hpp).
#pragma once

#include <string>
#include <vector>

namespace tack {

using Notes = std::vector<std::string>;

}  // namespace tack
