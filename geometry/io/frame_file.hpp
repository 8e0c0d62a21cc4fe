// Reads a frame of a run (framework/output/vtu.hpp), with all of its arrays.
// Errors: InputError naming the file, if it is unreadable or its cells are not tets, triangles,
// edges and points in this order.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

struct FrameArray {
  std::string name;
  std::string unit;  // SI; empty: none or unknown
  int components = 1;
  VecX values;  // components * vertices, or * cells
};

struct FrameFile {
  Mesh mesh;  // cells: tets, triangles, edges and points, in this order
  std::vector<FrameArray> vertex_arrays, cell_arrays;

  int cells() const;
};

FrameFile read_frame(const std::filesystem::path& path);

}  // namespace tack
