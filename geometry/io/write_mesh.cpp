#include "geometry/io/write_mesh.hpp"

#include <fmt/format.h>
#include <vtkCellTypes.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cerrno>
#include <fstream>

#include "geometry/errors.hpp"
#include "geometry/io/gltf.hpp"
#include "geometry/io/replace_file.hpp"
#include "geometry/msh_library.hpp"

namespace tack {
namespace {

template <class... Arguments>
void add(std::string& text, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
}

std::string off_text(const Mesh& mesh) {
  std::string text;
  add(text, "OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& x : mesh.vertices) add(text, "{} {} {}\n", x.x(), x.y(), x.z());
  for (const auto& [a, b, c] : mesh.triangles) add(text, "3 {} {} {}\n", a, b, c);
  return text;
}

std::string ply_text(const Mesh& mesh) {
  std::string text;
  add(text, "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
            "element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& x : mesh.vertices) add(text, "{} {} {}\n", x.x(), x.y(), x.z());
  for (const auto& [a, b, c] : mesh.triangles) add(text, "3 {} {} {}\n", a, b, c);
  return text;
}

// Writes ASCII, because binary .stl has single precision only.
std::string stl_text(const Mesh& mesh) {
  std::string text = "solid mesh\n";
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 &x = mesh.vertices[a], &y = mesh.vertices[b], &z = mesh.vertices[c], n = (y - x).cross(z - x).normalized();
    add(text, "facet normal {} {} {}\nouter loop\n", n.x(), n.y(), n.z());
    for (const Vec3* corner : {&x, &y, &z}) add(text, "vertex {} {} {}\n", corner->x(), corner->y(), corner->z());
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid mesh\n";
}

std::string obj_text(const Mesh& mesh) {
  std::string text;
  for (const Vec3& x : mesh.vertices) add(text, "v {} {} {}\n", x.x(), x.y(), x.z());
  for (const auto& [a, b, c] : mesh.triangles) add(text, "f {} {} {}\n", a + 1, b + 1, c + 1);
  for (const auto& [a, b] : mesh.edges) add(text, "l {} {}\n", a + 1, b + 1);
  for (const int v : mesh.points) add(text, "p {}\n", v + 1);
  return text;
}

template <class Writer>
std::string grid_text(const Mesh& mesh) {
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
  writer->SetInputData(grid);
  writer->WriteToOutputStringOn();
  writer->Write();
  if constexpr (std::is_same_v<Writer, vtkUnstructuredGridWriter>) return writer->GetOutputStdString();
  else return writer->GetOutputString();
}

// Writes a .msh file; returns true if it is complete. Gmsh does not report failures: an incomplete file lacks its end.
bool write_complete_msh(const std::filesystem::path& path, const Mesh& mesh) {
  write_msh(path, mesh);
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  constexpr std::string_view end = "$EndElements\n";
  std::string last(end.size(), '\0');
  file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  file.read(last.data(), static_cast<std::streamsize>(last.size()));
  errno = 0;  // not an error of writing
  return file && last == end;
}

// Throws InputError, before anything is written, for elements or positions that the format does not support.
void require_supported(const Mesh& mesh, const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  const bool all = extension == ".vtk" || extension == ".vtu" || extension == ".msh", gltf = extension == ".glb" || extension == ".gltf", lines = all || gltf || extension == ".obj";
  if (!lines && extension != ".off" && extension != ".ply" && extension != ".stl")
    throw InputError(fmt::format("{}: unknown mesh format \"{}\"; name the file .vtu, .vtk, .msh, .obj, .glb, .gltf, .off, .ply or .stl", path.string(),
                                 extension));
  if (!all && !mesh.tets.empty()) throw InputError(path.string() + ": such a file cannot hold tets; write .vtu, .vtk or .msh, or their surface (`tack mesh convert FILE surface=true`)");
  if (!lines && (!mesh.edges.empty() || !mesh.points.empty()))
    throw InputError(path.string() + ": such a file can hold triangles only; write .vtu, .vtk, .msh, .obj or .glb");
  if (!gltf) return;
  if (const auto [a, b] = merged_in_single_precision(mesh); a >= 0)
    throw InputError(fmt::format("{}: such a file has single precision, in which the vertices {} and {} coincide; move the mesh to the origin first "
                                 "(`tack mesh transform`), or write .obj", path.string(), a, b));
}

}  // namespace

void write_mesh(const std::filesystem::path& path, const Mesh& mesh) {
  require_supported(mesh, path);
  const std::string extension = path.extension().string();
  if (extension == ".obj") replace_file(path, obj_text(mesh));
  if (extension == ".off") replace_file(path, off_text(mesh));
  if (extension == ".ply") replace_file(path, ply_text(mesh));
  if (extension == ".stl") replace_file(path, stl_text(mesh));
  if (extension == ".glb") replace_file(path, glb_bytes(mesh));
  if (extension == ".gltf") replace_file(path, gltf_text(mesh));
  if (extension == ".vtk") replace_file(path, grid_text<vtkUnstructuredGridWriter>(mesh));
  if (extension == ".vtu") replace_file(path, grid_text<vtkXMLUnstructuredGridWriter>(mesh));
  if (extension == ".msh") replace_file_by(path, [&](const std::filesystem::path& draft) { return write_complete_msh(draft, mesh); });
}

}  // namespace tack
