// The build interface of a component library, read from its file before any of its code runs.
#pragma once

#include <string>

namespace tack {

// Returns "" for a library with the interface of this program. Otherwise describes the first line
// of interface.hpp that differs: "it was built for Eigen 3.3.9, this program is Eigen 3.4.0".
// Throws InputError, without a source location, if the file cannot be read, is no shared library,
// or has no interface note.
std::string interface_mismatch(const std::string& path);

}  // namespace tack
