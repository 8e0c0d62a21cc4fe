#include "framework/output/vtu.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <stdexcept>

#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

void require_size(const char* what, const std::string& name, Eigen::Index size, int expected) {
  if (size == expected) return;
  throw std::logic_error(
      fmt::format("{} '{}' of a frame has {} numbers, expected {}", what, name, size, expected));
}

vtkNew<vtkDoubleArray> to_array(const std::string& name, const VecX& values, int components) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(values.size() / components);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

class CellWriter {
 public:
  explicit CellWriter(int cells) {
    types_->SetNumberOfValues(cells);
    cells_->AllocateEstimate(cells, 4);
  }

  void add(int type, int count, const int* corners) {
    types_->SetValue(cells_->GetNumberOfCells(), static_cast<unsigned char>(type));
    cells_->InsertNextCell(count);
    for (int i = 0; i < count; ++i) cells_->InsertCellPoint(corners[i]);
  }
  template <class Element>
  void add(int type, const std::vector<Element>& elements) {
    for (const Element& e : elements) add(type, static_cast<int>(e.size()), e.data());
  }
  void move_to(vtkUnstructuredGrid* grid) { grid->SetCells(types_.Get(), cells_.Get()); }

 private:
  vtkNew<vtkUnsignedCharArray> types_;
  vtkNew<vtkCellArray> cells_;
};

void set_cells(vtkUnstructuredGrid* grid, const FrameGeometry& geometry) {
  CellWriter cells(geometry.cells());
  cells.add(VTK_TETRA, geometry.tets);
  cells.add(VTK_TRIANGLE, geometry.triangles);
  cells.add(VTK_LINE, geometry.edges);
  for (const int& v : geometry.points) cells.add(VTK_VERTEX, 1, &v);
  cells.move_to(grid);

  const auto objects = static_cast<Eigen::Index>(geometry.cell_object.size());
  require_size("cell array", "object", objects, geometry.cells());
  vtkNew<vtkIntArray> object;
  object->SetName("object");
  object->SetNumberOfValues(objects);
  std::copy(geometry.cell_object.begin(), geometry.cell_object.end(), object->GetPointer(0));
  grid->GetCellData()->AddArray(object);
}

void set_points(vtkUnstructuredGrid* grid, const FrameGeometry& geometry, const VecX& x) {
  require_size("array", "x", x.size(), 3 * geometry.vertices);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetData(to_array("Points", x, 3));
  grid->SetPoints(points);
}

vtkNew<vtkDoubleArray> to_array(const std::string& name, const VecX& values, int components, const std::string& unit) {
  auto array = to_array(name, values, components);
  if (!unit.empty()) array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit.c_str());
  return array;
}

void add_field(vtkUnstructuredGrid* grid, const FrameGeometry& geometry, const CellField& field) {
  require_size("cell field", field.name, field.values.size(), field.components * geometry.cells());
  grid->GetCellData()->AddArray(to_array(field.name, field.values, field.components, field.unit));
}

void add_field(vtkUnstructuredGrid* grid, const FrameGeometry& geometry, const PointField& field) {
  if (field.components != 1 && field.components != 3) {
    throw std::logic_error(fmt::format("field '{}' of a frame has {} components, expected 1 or 3",
                                       field.name, field.components));
  }
  require_size("field", field.name, field.values.size(), field.components * geometry.vertices);
  grid->GetPointData()->AddArray(to_array(field.name, field.values, field.components, field.unit));
}

std::string to_text(vtkUnstructuredGrid* grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);  // higher levels cost far more time than they save space
  writer->WriteToOutputStringOn();
  writer->Write();
  return writer->GetOutputString();
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const FrameGeometry& geometry, const VecX& x,
               double time, const std::vector<PointField>& fields, const std::vector<CellField>& cell_fields) {
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(grid, geometry, x);
  set_cells(grid, geometry);
  for (const PointField& field : fields) add_field(grid, geometry, field);
  for (const CellField& field : cell_fields) add_field(grid, geometry, field);
  grid->GetFieldData()->AddArray(to_array("TimeValue", VecX::Constant(1, time), 1));
  replace_file(path, to_text(grid));
}

}  // namespace tack
