// Notes of an operation on a mesh: a line each, without a newline. Those that begin with
// "warning: " are warnings (mesh_warnings.hpp).
#pragma once

#include <string>
#include <vector>

namespace tack {

using Notes = std::vector<std::string>;

}  // namespace tack
