// Reads a frame of a run (framework/output/vtu.hpp), with all of its arrays.
// Errors: InputError naming the file: unreadable, or cells that are not tets, triangles, edges and
// points in this order.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

struct FrameArray {
  std::string name;
  std::string unit;    // SI; empty: it has none, or none is known
  int components = 1;
  VecX values;         // components * vertices, or * cells
};

struct FrameFile {
  Mesh mesh;  // cells are its tets, triangles, edges and points, in this order
  std::vector<FrameArray> of_vertices, of_cells;

  int cells() const;
};

FrameFile read_frame(const std::filesystem::path& path);

}  // namespace tack
