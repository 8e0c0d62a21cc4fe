// Content of binary, little-endian .ply files (Greg Turk, The PLY Polygon File Format, 1994).
#pragma once

#include <fmt/format.h>

#include "framework/export/run_shapes.hpp"

namespace tack {

// Appends a file with an object: vertices in double precision, faces and edges. Texture
// coordinates are those of corners, as the list `texcoord` of faces (the convention of MeshLab).
// x: positions [m], multiplied by `scale`.
void append_ply(fmt::memory_buffer& content, const ExportedObject& object,
                const std::vector<Vec3>& x, double scale);

}  // namespace tack
