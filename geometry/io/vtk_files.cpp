// Readers of .stl, .vtk (legacy) and .vtu by VTK.
#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetReader.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSTLReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "geometry/errors.hpp"
#include "geometry/io/formats.hpp"
#include "geometry/io/frame_file.hpp"
#include "geometry/io/precheck.hpp"
#include "geometry/io/quiet_vtk.hpp"
#include "geometry/io/vtk_cells.hpp"
#include "geometry/mesh/cleanup.hpp"

namespace tack {
namespace {

template <class Reader>
vtkSmartPointer<vtkDataSet> read_data_set(Reader* reader, const std::string& name) {
  QuietVtk quiet;
  reader->SetFileName(name.c_str());
  reader->Update();
  vtkSmartPointer<vtkDataSet> data = vtkDataSet::SafeDownCast(reader->GetOutputDataObject(0));
  const std::string message = quiet.first_message();
  if (message.empty() && reader->GetErrorCode() == 0 && data) return data;
  throw InputError(fmt::format("{}: not a valid file of its format{}: export it again, or as one "
                               "of .obj .ply .off .msh",
                               name, message.empty() ? "" : " (" + message + ")"));
}

std::string unit_of(vtkDataArray& array) {
  vtkInformation* about = array.HasInformation() ? array.GetInformation() : nullptr;
  return about && about->Has(vtkDataArray::UNITS_LABEL()) ? about->Get(vtkDataArray::UNITS_LABEL()) : "";
}

std::vector<FrameArray> arrays_of(vtkFieldData& data) {
  std::vector<FrameArray> arrays;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data.GetArray(i);  // null: an array of strings
    if (!array || !array->GetName()) continue;
    const int components = array->GetNumberOfComponents();
    FrameArray& out = arrays.emplace_back(FrameArray{array->GetName(), unit_of(*array), components, {}});
    out.values.resize(array->GetNumberOfValues());
    for (vtkIdType t = 0; t < array->GetNumberOfTuples(); ++t)
      for (int c = 0; c < components; ++c) out.values(components * t + c) = array->GetComponent(t, c);
  }
  return arrays;
}

// Throws InputError unless cells are tets, triangles, edges and points in this order, so that the index of an element gives that of its
// cell.
void check_order(vtkDataSet& data, const FrameFile& frame, const std::string& name) {
  const Mesh& mesh = frame.mesh;
  const std::array<std::pair<int, std::size_t>, 4> expected = {{{VTK_TETRA, mesh.tets.size()}, {VTK_TRIANGLE, mesh.triangles.size()},
                                                                {VTK_LINE, mesh.edges.size()}, {VTK_VERTEX, mesh.points.size()}}};
  bool same = data.GetNumberOfCells() == frame.cells();
  vtkIdType cell = 0;
  for (const auto& [type, count] : expected)
    for (std::size_t i = 0; same && i < count; ++i) same = data.GetCellType(cell++) == type;
  if (!same) throw InputError(fmt::format("{}: is no frame of a run: its cells are not tets, triangles, edges and points in this order", name));
}

}  // namespace

int FrameFile::cells() const {
  return static_cast<int>(mesh.tets.size() + mesh.triangles.size() + mesh.edges.size() + mesh.points.size());
}

FrameFile read_frame(const std::filesystem::path& path) {
  const std::string name = path.string();
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  const auto data = read_data_set(reader.Get(), name);
  FrameFile frame;
  frame.mesh = mesh_of(*data, name);
  check_order(*data, frame, name);
  frame.vertex_arrays = arrays_of(*data->GetPointData());
  frame.cell_arrays = arrays_of(*data->GetCellData());
  return frame;
}

Mesh read_stl(const std::filesystem::path& path) {
  precheck_stl(path.string());
  vtkNew<vtkSTLReader> reader;
  reader->MergingOff();
  Mesh mesh = mesh_of(*read_data_set(reader.Get(), path.string()), path.string());
  merge_duplicate_vertices(mesh);
  if (mesh.triangles.empty()) {
    throw InputError(path.string() + ": no triangle found: is it an .stl file? Export it again");
  }
  return mesh;
}

Mesh read_vtk(const std::filesystem::path& path) {
  precheck_vtk(path.string());
  vtkNew<vtkDataSetReader> reader;
  return mesh_of(*read_data_set(reader.Get(), path.string()), path.string());
}

Mesh read_vtu(const std::filesystem::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  return mesh_of(*read_data_set(reader.Get(), path.string()), path.string());
}

}  // namespace tack
