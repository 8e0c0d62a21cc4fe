// Mesh files for tests to read.
#pragma once

#include <filesystem>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// .obj (no tets), .vtu, .msh (4.1, binary); coordinates keep every bit. Tags are not written. Throws InputError.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace tack
