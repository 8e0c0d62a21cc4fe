// Faces of .obj, .ply and .off files as they stand there: polygons, of .obj files with texture
// coordinates and materials, which a Mesh has not. Vertices and triangles are numbered as by
// read_mesh().
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct FileFaces {
  int vertices = 0;
  std::vector<int> sizes;       // corners of each face
  std::vector<int> corners;     // vertices of all faces, one face after the other
  std::vector<Vec2> uvs;        // texture coordinates
  std::vector<int> corner_uvs;  // per corner: index into uvs, -1 for none; empty: none at all
  std::vector<int> material;    // per face: index into materials, -1 for none
  std::vector<std::string> materials;
  std::vector<std::string> libraries;  // files of materials, relative to the .obj file
  std::vector<Triangle> triangles;     // of all faces, as read_mesh() cuts them
};

// Returns whether read_file_faces() knows the ending of the file.
bool has_file_faces(const std::filesystem::path& path);

// Throws InputError with the file, and the line of .obj files.
FileFaces read_file_faces(const std::filesystem::path& path);

}  // namespace tack
