#include "framework/output/vtu.hpp"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "tests/support/silence.hpp"

using namespace tack;

namespace {

// Every kind of cell, on six vertices.
FrameGeometry mixed() {
  FrameGeometry g;
  g.vertices = 6;
  g.tets = {{0, 1, 2, 3}};
  g.triangles = {{0, 2, 1}, {1, 2, 4}};
  g.edges = {{4, 5}};
  g.points = {5};
  g.cell_object = {0, 0, 1, 2, 3};
  return g;
}

VecX coordinates() { return VecX::LinSpaced(18, 0.1, 1.0 / 3.0); }

vtkSmartPointer<vtkUnstructuredGrid> read(const std::filesystem::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

std::string bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("a frame has the exact vertices and the time") {
  const TemporaryFolder folder;
  const VecX x = coordinates();
  write_vtu(folder.path() / "f.vtu", mixed(), x, 0.1 + 0.2, {});
  const auto grid = read(folder.path() / "f.vtu");
  REQUIRE(grid->GetNumberOfPoints() == 6);
  for (int v = 0; v < 6; ++v) {
    for (int k = 0; k < 3; ++k) CHECK(grid->GetPoint(v)[k] == x[3 * v + k]);
  }
  vtkDataArray* time = grid->GetFieldData()->GetArray("TimeValue");
  REQUIRE(time);
  CHECK(time->GetTuple1(0) == 0.1 + 0.2);
}

TEST_CASE("a frame has fields of cells, also with missing values") {
  const TemporaryFolder folder;
  VecX values(5);
  values << 1.0 / 3, 2, std::nan(""), -4, 0;
  write_vtu(folder.path() / "f.vtu", mixed(), coordinates(), 0, {}, {{"stress", values, "Pa"}});
  const auto grid = read(folder.path() / "f.vtu");
  vtkDataArray* stress = grid->GetCellData()->GetArray("stress");
  REQUIRE(stress);
  CHECK(std::string(stress->GetInformation()->Get(vtkDataArray::UNITS_LABEL())) == "Pa");
  for (const int c : {0, 1, 3, 4}) CHECK(stress->GetTuple1(c) == values(c));
  CHECK(std::isnan(stress->GetTuple1(2)));
  CHECK_THROWS_AS(write_vtu(folder.path() / "f.vtu", mixed(), coordinates(), 0, {}, {{"stress", VecX::Zero(4), "Pa"}}),
                  std::logic_error);
}

TEST_CASE("a frame has tets, triangles, edges and points, each with its object") {
  const TemporaryFolder folder;
  write_vtu(folder.path() / "f.vtu", mixed(), coordinates(), 0, {});
  const auto grid = read(folder.path() / "f.vtu");
  REQUIRE(grid->GetNumberOfCells() == 5);
  const std::vector<int> types = {VTK_TETRA, VTK_TRIANGLE, VTK_TRIANGLE, VTK_LINE, VTK_VERTEX};
  const std::vector<std::vector<int>> corners = {{0, 1, 2, 3}, {0, 2, 1}, {1, 2, 4}, {4, 5}, {5}};
  vtkDataArray* object = grid->GetCellData()->GetArray("object");
  REQUIRE(object);
  for (int c = 0; c < 5; ++c) {
    CHECK(grid->GetCellType(c) == types[c]);
    REQUIRE(grid->GetCell(c)->GetNumberOfPoints() == int(corners[c].size()));
    for (std::size_t i = 0; i < corners[c].size(); ++i) {
      CHECK(grid->GetCell(c)->GetPointId(int(i)) == corners[c][i]);
    }
    CHECK(object->GetTuple1(c) == mixed().cell_object[c]);
  }
}

TEST_CASE("a frame has fields with units") {
  const TemporaryFolder folder;
  const VecX speed = VecX::LinSpaced(18, -1, 1e-30);
  const VecX gap = VecX::LinSpaced(6, 0, 0.7);
  write_vtu(folder.path() / "f.vtu", mixed(), coordinates(), 0,
            {{"velocity", 3, speed, "m/s"}, {"gap", 1, gap, ""}});
  const auto grid = read(folder.path() / "f.vtu");
  vtkDataArray* velocity = grid->GetPointData()->GetArray("velocity");
  REQUIRE(velocity);
  REQUIRE(velocity->GetNumberOfComponents() == 3);
  for (int i = 0; i < 18; ++i) CHECK(velocity->GetComponent(i / 3, i % 3) == speed[i]);
  REQUIRE(velocity->HasInformation());
  CHECK(std::string(velocity->GetInformation()->Get(vtkDataArray::UNITS_LABEL())) == "m/s");
  vtkDataArray* gaps = grid->GetPointData()->GetArray("gap");
  REQUIRE(gaps);
  REQUIRE(gaps->GetNumberOfComponents() == 1);
  for (int i = 0; i < 6; ++i) CHECK(gaps->GetTuple1(i) == gap[i]);
}

TEST_CASE("equal frames give equal bytes, and no other file is left in the folder") {
  const TemporaryFolder folder;
  for (const char* name : {"a.vtu", "b.vtu"}) {
    write_vtu(folder.path() / name, mixed(), coordinates(), 1, {});
  }
  CHECK(bytes(folder.path() / "a.vtu") == bytes(folder.path() / "b.vtu"));
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 2);
}

TEST_CASE("a frame without vertices is a valid file") {
  const TemporaryFolder folder;
  write_vtu(folder.path() / "f.vtu", {}, VecX(), 0, {});
  CHECK(read(folder.path() / "f.vtu")->GetNumberOfPoints() == 0);
}

TEST_CASE("a frame refuses arrays that do not fit and paths that cannot be written") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "f.vtu";
  CHECK_THROWS_AS(write_vtu(path, mixed(), VecX::Zero(17), 0, {}), std::logic_error);
  CHECK_THROWS_WITH(write_vtu(path, mixed(), coordinates(), 0, {{"v", 3, VecX::Zero(6), ""}}),
                    "field 'v' of a frame has 6 numbers, expected 18");
  CHECK_THROWS_WITH(write_vtu(path, mixed(), coordinates(), 0, {{"v", 2, VecX::Zero(12), ""}}),
                    "field 'v' of a frame has 2 components, expected 1 or 3");
  FrameGeometry short_of_objects = mixed();
  short_of_objects.cell_object.pop_back();
  CHECK_THROWS_AS(write_vtu(path, short_of_objects, coordinates(), 0, {}), std::logic_error);
  CHECK_FALSE(std::filesystem::exists(path));
  const auto nowhere = folder.path() / "none" / "f.vtu";
  CHECK_THROWS_WITH(write_vtu(nowhere, mixed(), coordinates(), 0, {}),
                    Catch::StartsWith(nowhere.string() + ": cannot be written"));
}
