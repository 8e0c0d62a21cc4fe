#include "geometry/meshing_library.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "geometry/errors.hpp"
#include "geometry/meshing/functions.hpp"
#include "geometry/own_library.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr OwnLibrary own{"libtack_meshing.so", "tack_meshing_functions", TACK_MESHING_INTERFACE, "tack_meshing", "meshes cannot be made"};

const MeshingFunctions& library() {
  static const MeshingFunctions& functions = *static_cast<const MeshingFunctions*>(open_library(own));
  return functions;
}

}  // namespace

void open_meshing_library() { library(); }

std::string meshing_library_stamp() {
  std::error_code none;
  const fs::path path = own_library_path(own.file);
  if (!fs::exists(path, none)) return "";
  return fmt::format("{} {}", fs::file_size(path, none), fs::last_write_time(path, none).time_since_epoch().count());
}

Mesh boolean(Boolean kind, const Mesh& a, const Mesh& b, const std::string& name_a, const std::string& name_b, Notes& notes) {
  return library().boolean(kind, a, b, name_a, name_b, notes);
}
Mesh cut(const Mesh& mesh, const Vec3& point, const Vec3& normal, const std::string& name, Notes& notes) {
  return library().cut(mesh, point, normal, name, notes);
}
SurfaceDefects find_defects(const Mesh& surface, bool crossings) { return library().find_defects(surface, crossings); }
std::vector<std::string> list_defects(const SurfaceDefects& defects) { return library().list_defects(defects); }
void require_solid(const Mesh& surface, const std::string& name) { library().require_solid(surface, name); }
void require_oriented_manifold(const Mesh& surface, const std::string& name) { library().require_oriented_manifold(surface, name); }
bool SurfaceDefects::bounds_volume() const { return library().bounds_volume(*this); }
Mesh offset(const Mesh& mesh, const OffsetOptions& options, const std::string& name, Notes& notes) {
  return library().offset(mesh, options, name, notes);
}
Mesh remesh(const Mesh& mesh, const RemeshOptions& options, const std::string& name, Notes& notes) {
  return library().remesh(mesh, options, name, notes);
}
Mesh repair(const Mesh& mesh, const RepairOptions& options, const std::string& name, Notes& notes) {
  return library().repair(mesh, options, name, notes);
}
Mesh simplify(const Mesh& mesh, int triangles, const std::string& name, Notes& notes) {
  return library().simplify(mesh, triangles, name, notes);
}
Mesh subdivide(const Mesh& mesh, SubdivisionRule rule, int times, const std::string& name, Notes& notes) {
  return library().subdivide(mesh, rule, times, name, notes);
}
SurfaceDeviation surface_deviation(const Mesh& from, const Mesh& to, double spacing) { return library().surface_deviation(from, to, spacing); }
Mesh tetrahedralize(const Mesh& mesh, const TetrahedralizeOptions& options, const std::string& name, Notes& notes) {
  return library().tetrahedralize(mesh, options, name, notes);
}
FlatMesh triangulate(const std::vector<Vec2>& polygon, double edge_length, const std::string& name) {
  return library().triangulate(polygon, edge_length, name);
}

DistanceGrid DistanceGrid::of(const DistanceFunction& function, const Eigen::AlignedBox3d& box, double voxel) {
  return library().grid_of_function(function, box, voxel);
}
DistanceGrid DistanceGrid::of(const Mesh& mesh, double voxel, double band) { return library().grid_of_mesh(mesh, voxel, band); }
double DistanceGrid::lowest() const { return library().grid_lowest(*this); }
void DistanceGrid::sample(std::span<const Vec3> points, std::span<double> distances) const {
  library().grid_sample(*this, points, distances);
}
Mesh DistanceGrid::surface() const { return library().grid_surface(*this); }
Eigen::AlignedBox3d DistanceGrid::voxel_of(const Vec3& point) const { return library().grid_voxel_of(*this, point); }

}  // namespace tack
