// Runs a reader of mesh files in a child process (geometry/isolated_process.hpp). If VTK, Gmsh or
// CGAL crashes, loops or takes all memory on a damaged file, that becomes an error that names the
// file. Earlier checks (precheck.hpp) cover only known kinds of damage.
//
// Limits: memory of the program plus 1 GiB plus 64 times the size of the file; processor time of 5
// s plus 1 s per 256 KiB; ten times that in wall time.
#pragma once

#include <filesystem>

#include "geometry/mesh/mesh.hpp"

namespace tack {

using MeshReader = Mesh (*)(const std::filesystem::path& path);

// Returns the mesh of the reader. Throws the reader's InputError, or one that says how the process
// ended.
Mesh read_isolated(const std::filesystem::path& path, MeshReader read);

}  // namespace tack
