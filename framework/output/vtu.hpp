// One frame of a run as a VTK unstructured grid (.vtu) for ParaView.
//
// Points are all vertices of the scene in their order; cells are tets, then triangles, edges and
// single points, each with the index of its object (cell array "object") and further numbers. The time stands in the
// field array TimeValue [s]. Numbers keep every bit: raw appended data, compressed by zlib. The
// same frame gives the same bytes.
// Errors: InputError naming the file when it cannot be written; std::logic_error when an array does
// not fit the geometry.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

// What does not change between frames.
struct FrameGeometry {
  int vertices = 0;
  std::vector<Tet> tets;
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
  std::vector<int> points;
  std::vector<int> cell_object;  // one per cell, in the order of the lists above

  int cells() const {
    return static_cast<int>(tets.size() + triangles.size() + edges.size() + points.size());
  }
};

// A number or a vector per vertex.
struct PointField {
  std::string name;
  int components = 1;  // 1 or 3
  VecX values;         // components * vertices
  std::string unit;    // SI, such as "m/s"; kept in the file beside the array
};

// Numbers per cell.
struct CellField {
  std::string name;
  VecX values;  // components * cells
  std::string unit;
  int components = 1;  // 1, 3, or 6 of a symmetric tensor: xx, yy, zz, xy, yz, xz
};

// x: 3 * vertices coordinates [m].
void write_vtu(const std::filesystem::path& path, const FrameGeometry& geometry, const VecX& x,
               double time, const std::vector<PointField>& fields, const std::vector<CellField>& cell_fields = {});

}  // namespace tack
