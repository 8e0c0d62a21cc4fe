// What the file of a library of components says that it was built against, before any of it runs.
#pragma once

#include <string>

namespace tack {

// "" for what this program was built against too. Otherwise the first line of interface.hpp that differs: "it was built for Eigen 3.3.9, this program
// is Eigen 3.4.0". Throws InputError, without a place, if it cannot be read, is no shared library, or has no such note.
std::string built_against_another(const std::string& path);

}  // namespace tack
