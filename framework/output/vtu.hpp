// Writes one frame of a run as a VTK unstructured grid (.vtu) for ParaView.
//
// Points: all vertices of the scene in their order. Cells: tetrahedra, then triangles, edges and
// single points, with the index of their object (cell array "object") and further fields. The field
// array TimeValue holds the time [s]. Numbers are exact: raw appended data, compressed by zlib;
// equal frames give equal bytes.
// Errors: InputError with the file if it cannot be written; std::logic_error if an array does not
// fit the geometry.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

// Data that frames share.
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

// A scalar or vector field on vertices.
struct PointField {
  std::string name;
  int components = 1;  // 1 or 3
  VecX values;         // components * vertices
  std::string unit;    // SI, such as "m/s"; stored with the array
};

// A field on cells.
struct CellField {
  std::string name;
  VecX values;  // components * cells
  std::string unit;
  int components = 1;  // 1, 3, or 6 of a symmetric tensor: xx, yy, zz, xy, yz, xz
};

// Writes a frame. x: 3 * vertices coordinates [m].
void write_vtu(const std::filesystem::path& path, const FrameGeometry& geometry, const VecX& x,
               double time, const std::vector<PointField>& fields,
               const std::vector<CellField>& cell_fields = {});

}  // namespace tack
