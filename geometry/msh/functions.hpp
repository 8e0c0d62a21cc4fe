// Function table of the shared library libtack_msh.so: .msh files by Gmsh, which takes longer to
// load than the rest of the program. The first .msh file opens it (msh_library.hpp).
#pragma once

#include <string>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Returns all elements of the file. Throws InputError naming the file.
Mesh read_msh_by_gmsh(const std::string& path);
void write_msh_by_gmsh(const std::string& path, const Mesh& mesh);

struct MshFunctions {
  // TACK_MSH_INTERFACE: a digest of these headers and of how they were compiled.
  const char* interface;
  decltype(&read_msh_by_gmsh) read;
  decltype(&write_msh_by_gmsh) write;
};

}  // namespace tack
