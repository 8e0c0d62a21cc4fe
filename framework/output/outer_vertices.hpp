// Outer vertices of a frame by object.
#pragma once

#include <vector>

#include "geometry/io/frame_file.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {

// Returns the object of each vertex of a frame, by its cells; -1: of no cell.
std::vector<int> objects_of_vertices(const FrameFile& frame);

// Returns the vertices of outer faces, sheets, edges and points of each object, ascending; as many
// objects as own cells, at least `count`. surface: of the frame's mesh. Remeshing inside keeps them
// and their order.
std::vector<std::vector<int>> outer_vertices(const FrameFile& frame, const Surface& surface,
                                             int count = 0);

}  // namespace tack
