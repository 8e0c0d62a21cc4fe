#include "geometry/io/vtk_cells.hpp"

#include <fmt/format.h>
#include <vtkCellTypes.h>
#include <vtkDataSet.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointSet.h>

#include "geometry/errors.hpp"
#include "geometry/io/polygon.hpp"
#include "geometry/mesh/validate.hpp"

namespace tack {
namespace {

// Throws InputError for indices out of range, which VTK does not check.
void check_corners(const Mesh& mesh, vtkIdList& corners, const std::string& where) {
  const auto count = static_cast<vtkIdType>(mesh.vertices.size());
  for (const vtkIdType v : corners) {
    if (v >= 0 && v < count) continue;
    throw InputError(fmt::format("{} refers to vertex {} (counted from 0) of {}: correct the index "
                                 "or add the vertex",
                                 where, v, count));
  }
}

void add_cell(Mesh& mesh, int type, const std::vector<int>& v, const std::string& where) {
  const auto expect = [&](std::size_t corners) {
    if (v.size() == corners) return;
    throw InputError(fmt::format("{} has {} vertices, but its kind has {}: export the file again",
                                 where, v.size(), corners));
  };
  switch (type) {
    case VTK_EMPTY_CELL:
      return;
    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
      mesh.points.insert(mesh.points.end(), v.begin(), v.end());
      return;
    case VTK_LINE:
      expect(2);
      [[fallthrough]];
    case VTK_POLY_LINE:
      for (std::size_t i = 0; i + 1 < v.size(); ++i) mesh.edges.push_back({v[i], v[i + 1]});
      return;
    case VTK_TRIANGLE:
    case VTK_QUAD:
    case VTK_POLYGON:
      return add_polygon(mesh, v, where);
    case VTK_TETRA:
      expect(4);
      mesh.tets.push_back({v[0], v[1], v[2], v[3]});
      return;
    default:
      throw InputError(fmt::format("{} is a {}: supported are vertices, lines, triangles, quads, "
                                   "polygons and linear tets; convert it to those",
                                   where, vtkCellTypes::GetClassNameFromTypeId(type)));
  }
}

}  // namespace

Mesh mesh_of(vtkDataSet& data, const std::string& name) {
  if (!vtkPointSet::SafeDownCast(&data)) {
    throw InputError(fmt::format("{}: holds a {}: give an unstructured grid or poly data", name,
                                 data.GetClassName()));
  }
  Mesh mesh;
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    mesh.vertices.emplace_back(Eigen::Map<const Vec3>(data.GetPoint(i)));
  }
  validate_coordinates(mesh, name);
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < data.GetNumberOfCells(); ++c) {
    const std::string where = fmt::format("{}: cell {}", name, c);
    data.GetCellPoints(c, corners);
    check_corners(mesh, *corners, where);
    add_cell(mesh, data.GetCellType(c), {corners->begin(), corners->end()}, where);
  }
  return mesh;
}

}  // namespace tack
