// Shared library of msh/functions.hpp. Reading or writing the first .msh file opens it.
#pragma once

#include <filesystem>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Opens the library now. Call it before a fork, so that the child need not load it. Throws
// InputError if it is missing or of another build.
void open_msh_library();

void write_msh(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace tack
