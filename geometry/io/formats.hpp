// Readers of mesh formats for read_mesh, one external library per source file. They expect an
// existing, non-empty file; read_mesh does the last checks of indices and coordinates.
#pragma once

#include <filesystem>

#include "geometry/io/file_faces.hpp"
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

// Readers for read_file_faces().
FileFaces read_obj_faces(const std::filesystem::path& path);
FileFaces read_polygon_faces(const std::filesystem::path& path, bool is_ply);

}  // namespace tack
