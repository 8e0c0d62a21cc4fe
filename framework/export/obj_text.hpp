// Text of Wavefront .obj and .mtl files.
#pragma once

#include <fmt/format.h>

#include <string>

#include "framework/export/run_shapes.hpp"

namespace tack {

// Appends an object with its faces (texture coordinates and materials included), edges and points.
// x: positions [m], multiplied by `scale`. library: file of the materials.
void append_obj(fmt::memory_buffer& text, const ExportedObject& object, const std::vector<Vec3>& x,
                double scale, const std::string& library);

std::string mtl_text(const ExportedObject& object);

}  // namespace tack
