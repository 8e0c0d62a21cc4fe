// Runs a reader of foreign mesh files in a process of its own (geometry/isolated_process.hpp). What
// VTK, Gmsh and CGAL do with a hostile file (crash, loop, take all memory) becomes an error that
// names the file; checks before (precheck.hpp) only cover the damage that somebody thought of.
//
// Limits: 1 GiB of memory and 64 times the file's size more than the program has; 5 s of processor
// time and a second for each 256 KiB; ten times that in wall time.
#pragma once

#include <filesystem>

#include "geometry/mesh/mesh.hpp"

namespace tack {

using MeshReader = Mesh (*)(const std::filesystem::path& path);

// Returns the mesh of the reader. Throws the reader's InputError, or one that says how the process
// ended.
Mesh read_isolated(const std::filesystem::path& path, MeshReader read);

}  // namespace tack
