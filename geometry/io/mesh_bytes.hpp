// Conversion between meshes and bytes, to pass a mesh from one process of a program to another.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "geometry/mesh/mesh.hpp"

namespace tack {

std::string bytes_of(const Mesh& mesh);
// Returns the mesh; none if the bytes are not exactly those of a mesh: the writer may have crashed.
std::optional<Mesh> mesh_from(std::string_view bytes);

}  // namespace tack
