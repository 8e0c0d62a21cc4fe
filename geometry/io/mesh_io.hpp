// Mesh files; the format follows from the extension (upper or lower case).
//   .obj       v, f (any polygon), l, p; groups (g, o) become tags
//   .ply .off  polygon meshes, ASCII and (.ply) binary
//   .stl       ASCII and binary; equal corners are merged, as the format has no shared vertices
//   .glb .gltf the scene of a glTF 2.0 file, with node transforms applied; equal vertices are
//              merged, because each normal and colour has its own; single precision
//   .vtk .vtu  points, lines, triangles, polygons, tets of unstructured grids; .vtk also poly data
//   .msh       Gmsh 2.2 and 4.1, ASCII and binary: points, lines, triangles, tets; physical groups
//              become tags (an unnamed one is named by its number)
// Vertex i of the file is vertex i of the mesh (.msh: vertices by ascending node number), except in
// .stl and glTF. Coordinates are taken as metres. Polygons are cut into triangles. A file with
// vertices but no element is a point cloud: every vertex becomes a point. In .msh, elements that
// are faces or edges of others (cleanup.hpp) only carry groups and are dropped.
// Errors: InputError naming the file and the remedy: missing, empty or unreadable files, unknown
// formats, cells of other kinds (hexahedra, curved elements), indices out of range, non-finite
// coordinates. Inverted or flat elements are no errors here (validate.hpp checks them).
#pragma once

#include <filesystem>

#include "geometry/mesh/mesh.hpp"

namespace tack {

Mesh read_mesh(const std::filesystem::path& path);

}  // namespace tack
