#include "geometry/io/write_mesh.hpp"

#include <fmt/format.h>
#include <vtkCellTypes.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <fstream>

#include "geometry/errors.hpp"
#include "geometry/msh_library.hpp"

namespace tack {
namespace {

void write_off(const std::filesystem::path& path, const Mesh& mesh) {
  std::ofstream file(path);
  file << fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& x : mesh.vertices) file << fmt::format("{} {} {}\n", x.x(), x.y(), x.z());
  for (const auto& [a, b, c] : mesh.triangles) file << fmt::format("3 {} {} {}\n", a, b, c);
}

void write_ply(const std::filesystem::path& path, const Mesh& mesh) {
  std::ofstream file(path);
  file << fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
                      "element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.vertices.size(),
                      mesh.triangles.size());
  for (const Vec3& x : mesh.vertices) file << fmt::format("{} {} {}\n", x.x(), x.y(), x.z());
  for (const auto& [a, b, c] : mesh.triangles) file << fmt::format("3 {} {} {}\n", a, b, c);
}

// ASCII: the binary form has single precision only.
void write_stl(const std::filesystem::path& path, const Mesh& mesh) {
  std::ofstream file(path);
  file << "solid mesh\n";
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 &x = mesh.vertices[a], &y = mesh.vertices[b], &z = mesh.vertices[c], n = (y - x).cross(z - x).normalized();
    file << fmt::format("facet normal {} {} {}\nouter loop\n", n.x(), n.y(), n.z());
    for (const Vec3* corner : {&x, &y, &z}) file << fmt::format("vertex {} {} {}\n", corner->x(), corner->y(), corner->z());
    file << "endloop\nendfacet\n";
  }
  file << "endsolid mesh\n";
}

void write_obj(const std::filesystem::path& path, const Mesh& mesh) {
  std::ofstream file(path);
  for (const Vec3& x : mesh.vertices) file << fmt::format("v {} {} {}\n", x.x(), x.y(), x.z());
  for (const auto& [a, b, c] : mesh.triangles) file << fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  for (const auto& [a, b] : mesh.edges) file << fmt::format("l {} {}\n", a + 1, b + 1);
  for (const int v : mesh.points) file << fmt::format("p {}\n", v + 1);
}

template <class Writer>
void write_grid(const std::filesystem::path& path, const Mesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& x : mesh.vertices) points->InsertNextPoint(x.data());
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->Allocate();
  const auto insert = [&](int type, const auto& elements) {
    for (const auto& element : elements) {
      const std::vector<vtkIdType> ids(element.begin(), element.end());
      grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
    }
  };
  insert(VTK_TETRA, mesh.tets);
  insert(VTK_TRIANGLE, mesh.triangles);
  insert(VTK_LINE, mesh.edges);
  for (const int v : mesh.points) insert(VTK_VERTEX, std::array<std::array<int, 1>, 1>{{{v}}});
  vtkNew<Writer> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(grid);
  writer->Write();
}

// What cannot be written is told before anything is.
void require_place_for(const Mesh& mesh, const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  const bool all = extension == ".vtk" || extension == ".vtu" || extension == ".msh", lines = all || extension == ".obj";
  if (!lines && extension != ".off" && extension != ".ply" && extension != ".stl")
    throw InputError(fmt::format("{}: unknown mesh format \"{}\"; name the file .vtu, .vtk, .msh, .obj, .off, .ply or .stl", path.string(),
                                 extension));
  if (!all && !mesh.tets.empty()) throw InputError(path.string() + ": such a file cannot hold tets; write .vtu, .vtk or .msh");
  if (!lines && (!mesh.edges.empty() || !mesh.points.empty()))
    throw InputError(path.string() + ": such a file can hold triangles only; write .vtu, .vtk, .msh or .obj");
  if (!std::ofstream(path)) throw InputError(path.string() + ": cannot be written; choose a folder that exists");
}

}  // namespace

void write_mesh(const std::filesystem::path& path, const Mesh& mesh) {
  require_place_for(mesh, path);
  const std::string extension = path.extension().string();
  if (extension == ".obj") write_obj(path, mesh);
  if (extension == ".off") write_off(path, mesh);
  if (extension == ".ply") write_ply(path, mesh);
  if (extension == ".stl") write_stl(path, mesh);
  if (extension == ".vtk") write_grid<vtkUnstructuredGridWriter>(path, mesh);
  if (extension == ".vtu") write_grid<vtkXMLUnstructuredGridWriter>(path, mesh);
  if (extension == ".msh") write_msh(path, mesh);
}

}  // namespace tack
