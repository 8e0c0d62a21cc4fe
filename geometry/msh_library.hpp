// The shared library of msh/functions.hpp, which is opened when the first .msh file is read or
// written.
#pragma once

#include <filesystem>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Opens it now: before a process is forked, which would have to load it for itself. Throws
// InputError if it is not there or of another build.
void open_msh_library();

void write_msh(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace tack
