// Meshes that take long to make, made once: kept by their recipe in this process, and in a folder for the next one.
//
// The recipe is what the scene says of the shape, with all that it holds, the bytes of the files that it reads, and this very
// program, so that a mesh is made anew whenever it might come out in another way. Files that are damaged or of another recipe
// are not used.
#pragma once

#include <filesystem>
#include <memory>

#include "framework/shapes/shape_source.hpp"

namespace tack {

struct MadeMesh {
  Mesh mesh;
  std::vector<std::string> notes;  // ShapeSource::notes
};

// shape.make(), unless its recipe was made before. Throws what make() throws.
std::shared_ptr<const MadeMesh> made(const ShapeSource& shape);

// Where meshes are kept, made when there is one to keep; empty, as at the start: nowhere. A folder that cannot be written to is
// none. Not while meshes are being made.
void keep_meshes_in(const std::filesystem::path& folder);

// What the environment variable TACK_MESHES says ("none": nowhere), or `results/meshes`.
std::filesystem::path usual_mesh_folder();

}  // namespace tack
