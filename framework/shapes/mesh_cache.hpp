// Cache of costly meshes by recipe: in the process, and in a folder for later processes.
//
// A recipe contains the scene entry of the shape with all components, the bytes of the files that
// it reads, and the identity of this program, so that a mesh is made again whenever it could
// differ. Files that are damaged or have another recipe are ignored.
#pragma once

#include <filesystem>
#include <memory>

#include "framework/shapes/shape_source.hpp"

namespace tack {

struct ShapeMesh {
  Mesh mesh;
  std::vector<std::string> notes;  // ShapeSource::notes
};

// Returns the cached mesh, or else shape.make(). Throws the exceptions of make().
std::shared_ptr<const ShapeMesh> mesh_of_shape(const ShapeSource& shape);

// Sets the folder of the cache; it is created when needed. Empty (the default): no folder. A folder
// that is not writable is ignored. Do not call this while meshes are being made.
void set_mesh_cache_folder(const std::filesystem::path& folder);

// Returns the value of TACK_MESHES ("none": no folder), by default `results/meshes`.
std::filesystem::path default_mesh_cache_folder();

}  // namespace tack
