// Writes mesh files; the format follows from the extension.
//   .vtu .vtk .msh (4.1, binary)   everything
//   .obj .glb .gltf                all but tets
//   .off .ply .stl (ASCII)         triangles only
// Coordinates keep every bit, except in .vtk (ASCII) and glTF (single precision). Groups are not
// written. Errors: InputError naming the file and the remedy, for an unknown extension, elements
// that the format does not support, vertices that coincide in the precision of glTF, and a file
// that cannot be written.
#pragma once

#include <filesystem>

#include "geometry/mesh/mesh.hpp"

namespace tack {

void write_mesh(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace tack
