// Readers of .ply and .off by CGAL, which keeps double precision and the order of the vertices.
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "geometry/errors.hpp"
#include "geometry/io/formats.hpp"
#include "geometry/io/polygon.hpp"
#include "geometry/io/precheck.hpp"
#include "geometry/mesh/validate.hpp"

namespace tack {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Polygons = std::vector<std::vector<std::size_t>>;

bool read_soup(const std::string& path, bool is_ply, std::vector<Point>& points,
               Polygons& polygons) {
  const auto quiet = CGAL::parameters::verbose(false);
  try {
    return is_ply ? CGAL::IO::read_PLY(path, points, polygons, quiet)
                  : CGAL::IO::read_OFF(path, points, polygons, quiet);
  } catch (const std::exception&) {
    return false;  // bad_alloc and length_error: a header with absurd counts
  }
}

// faces: receives the polygons; null: not wanted.
Mesh read_polygons(const std::string& name, bool is_ply, FileFaces* faces = nullptr) {
  std::vector<Point> points;
  Polygons polygons;
  if (!read_soup(name, is_ply, points, polygons)) {
    throw InputError(fmt::format("{}: not a valid {} polygon mesh, or cut short: export it again, "
                                 "or as one of .obj .stl .vtk .vtu .msh",
                                 name, is_ply ? ".ply" : ".off"));
  }
  Mesh mesh;
  for (const Point& p : points) mesh.vertices.emplace_back(p.x(), p.y(), p.z());
  validate_coordinates(mesh, name);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    std::vector<int> corners;
    for (std::size_t v : polygons[i]) {
      corners.push_back(static_cast<int>(std::min(v, points.size())));  // out of range stays so
    }
    add_polygon(mesh, corners, fmt::format("{}: face {}", name, i));
    if (!faces) continue;
    faces->sizes.push_back(static_cast<int>(corners.size()));
    faces->corners.insert(faces->corners.end(), corners.begin(), corners.end());
    faces->material.push_back(-1);
  }
  return mesh;
}

}  // namespace

Mesh read_ply(const std::filesystem::path& path) {
  precheck_ply(path.string());
  return read_polygons(path.string(), true);
}

Mesh read_off(const std::filesystem::path& path) { return read_polygons(path.string(), false); }

FileFaces read_polygon_faces(const std::filesystem::path& path, bool is_ply) {
  if (is_ply) precheck_ply(path.string());
  FileFaces faces;
  const Mesh mesh = read_polygons(path.string(), is_ply, &faces);
  faces.vertices = static_cast<int>(mesh.vertices.size());
  faces.triangles = mesh.triangles;
  return faces;
}

}  // namespace tack
