#include "geometry/io/mesh_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <numeric>

#include "geometry/errors.hpp"
#include "geometry/io/file_faces.hpp"
#include "geometry/io/formats.hpp"
#include "geometry/io/isolated.hpp"
#include "geometry/mesh/validate.hpp"
#include "geometry/msh_library.hpp"

namespace tack {
namespace {

constexpr const char* supported = ".obj .ply .off .stl .glb .gltf .vtk .vtu .msh";

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void check_readable(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (!fs::exists(path, ignored)) {
    throw InputError(path.string() + ": there is no such mesh file: check the path");
  }
  if (!fs::is_regular_file(path, ignored) || !std::ifstream(path)) {
    throw InputError(path.string() + ": cannot be read: check its kind and permissions");
  }
  if (fs::file_size(path, ignored) == 0) {
    throw InputError(path.string() + ": the mesh file is empty: export it again");
  }
}

Mesh read_by_extension(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".obj") return read_obj(path);
  if (extension == ".ply") return read_isolated(path, read_ply);
  if (extension == ".off") return read_isolated(path, read_off);
  if (extension == ".stl") return read_isolated(path, read_stl);
  if (extension == ".glb" || extension == ".gltf") return read_isolated(path, read_gltf);
  if (extension == ".vtk") return read_isolated(path, read_vtk);
  if (extension == ".vtu") return read_isolated(path, read_vtu);
  if (extension == ".msh") {
    open_msh_library();
    return read_isolated(path, read_msh);
  }
  throw InputError(fmt::format("{}: unknown mesh format \"{}\": convert it to one of {}",
                               path.string(), extension, supported));
}

}  // namespace

bool has_file_faces(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".obj" || extension == ".ply" || extension == ".off";
}

FileFaces read_file_faces(const std::filesystem::path& path) {
  read_mesh(path);  // in a process of its own: what comes through it is not damaged
  const std::string extension = extension_of(path);
  return extension == ".obj" ? read_obj_faces(path) : read_polygon_faces(path, extension == ".ply");
}

Mesh read_mesh(const std::filesystem::path& path) {
  check_readable(path);
  Mesh mesh = read_by_extension(path);
  const std::string name = path.string();
  if (mesh.vertices.empty()) {
    throw InputError(fmt::format("{}: no vertex found: is it a file of that format? Supported are "
                                 "{}",
                                 name, supported));
  }
  validate_indices(mesh, name);
  validate_coordinates(mesh, name);
  if (mesh.tets.empty() && mesh.triangles.empty() && mesh.edges.empty() && mesh.points.empty()) {
    mesh.points.resize(mesh.vertices.size());
    std::iota(mesh.points.begin(), mesh.points.end(), 0);
  }
  return mesh;
}

}  // namespace tack
