// The readers behind read_mesh, one foreign library per .cpp. They
// expect an existing, non-empty file and leave the last checks of indices and coordinates to
// read_mesh.
#pragma once

#include <filesystem>

#include "geometry/mesh/mesh.hpp"

namespace tack {

Mesh read_obj(const std::filesystem::path& path);
Mesh read_ply(const std::filesystem::path& path);
Mesh read_off(const std::filesystem::path& path);
Mesh read_stl(const std::filesystem::path& path);
Mesh read_vtk(const std::filesystem::path& path);
Mesh read_vtu(const std::filesystem::path& path);
Mesh read_gltf(const std::filesystem::path& path);
Mesh read_msh(const std::filesystem::path& path);

}  // namespace tack
