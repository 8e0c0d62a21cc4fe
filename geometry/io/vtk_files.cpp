// .stl, .vtk (legacy) and .vtu through VTK.
#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetReader.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkSTLReader.h>
#include <vtkStringOutputWindow.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <mutex>

#include "geometry/errors.hpp"
#include "geometry/io/formats.hpp"
#include "geometry/io/frame_file.hpp"
#include "geometry/io/polygon.hpp"
#include "geometry/io/precheck.hpp"
#include "geometry/mesh/cleanup.hpp"
#include "geometry/mesh/validate.hpp"

namespace tack {
namespace {

// While it lives, what VTK would print on the terminal is collected instead. VTK keeps one output
// window per process, hence the lock. Its logger, which prints the same once more, is turned off.
class QuietVtk {
 public:
  QuietVtk() : lock_(mutex()), before_(vtkOutputWindow::GetInstance()) {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkOutputWindow::SetInstance(window_);
  }
  ~QuietVtk() { vtkOutputWindow::SetInstance(before_); }
  QuietVtk(const QuietVtk&) = delete;
  QuietVtk& operator=(const QuietVtk&) = delete;

  // First complaint, without VTK's decoration: "ERROR: In file.cxx, line 3\nClass (0x..): text\n".
  std::string first_message() {
    std::string text = window_->GetOutput();
    if (const auto at = text.find('\n'); at != text.npos) text = text.substr(at + 1);
    text = text.substr(0, text.find('\n'));
    if (const auto at = text.find("): "); at != text.npos) text = text.substr(at + 3);
    return text;
  }

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }

  std::lock_guard<std::mutex> lock_;
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkNew<vtkStringOutputWindow> window_;
};

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

// Checked here because VTK itself follows numbers out of range.
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

Mesh to_mesh(vtkDataSet& data, const std::string& name) {
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

std::string unit_of(vtkDataArray& array) {
  vtkInformation* about = array.HasInformation() ? array.GetInformation() : nullptr;
  return about && about->Has(vtkDataArray::UNITS_LABEL()) ? about->Get(vtkDataArray::UNITS_LABEL()) : "";
}

std::vector<FrameArray> arrays_of(vtkFieldData& data) {
  std::vector<FrameArray> arrays;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data.GetArray(i);  // null: of texts
    if (!array || !array->GetName()) continue;
    const int components = array->GetNumberOfComponents();
    FrameArray& out = arrays.emplace_back(FrameArray{array->GetName(), unit_of(*array), components, {}});
    out.values.resize(array->GetNumberOfValues());
    for (vtkIdType t = 0; t < array->GetNumberOfTuples(); ++t)
      for (int c = 0; c < components; ++c) out.values(components * t + c) = array->GetComponent(t, c);
  }
  return arrays;
}

// Tets, triangles, edges and points in this order, so that a cell's number follows from that of its element.
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
  frame.mesh = to_mesh(*data, name);
  check_order(*data, frame, name);
  frame.of_vertices = arrays_of(*data->GetPointData());
  frame.of_cells = arrays_of(*data->GetCellData());
  return frame;
}

Mesh read_stl(const std::filesystem::path& path) {
  precheck_stl(path.string());
  vtkNew<vtkSTLReader> reader;
  reader->MergingOff();
  Mesh mesh = to_mesh(*read_data_set(reader.Get(), path.string()), path.string());
  merge_duplicate_vertices(mesh);
  if (mesh.triangles.empty()) {
    throw InputError(path.string() + ": no triangle found: is it an .stl file? Export it again");
  }
  return mesh;
}

Mesh read_vtk(const std::filesystem::path& path) {
  precheck_vtk(path.string());
  vtkNew<vtkDataSetReader> reader;
  return to_mesh(*read_data_set(reader.Get(), path.string()), path.string());
}

Mesh read_vtu(const std::filesystem::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  return to_mesh(*read_data_set(reader.Get(), path.string()), path.string());
}

}  // namespace tack
