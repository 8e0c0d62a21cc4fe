// Polygons, texture coordinates and materials of the .obj file, or polygons of the .ply or .off
// file, that an object's shape was read from.
#pragma once

#include "framework/config/value.hpp"
#include "framework/export/run_shapes.hpp"

namespace tack {

// Replaces the triangles of an object by the faces of its file, with texture coordinates and the
// colours of its materials (Kd of .mtl files). shape: the entry of the object in the scene.
// Returns "" if there is no such file, or if its faces were taken; else why the object keeps its
// triangles.
std::string take_source_faces(const Value& shape, ExportedObject& object);

}  // namespace tack
