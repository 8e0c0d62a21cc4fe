#include "geometry/meshing/offset.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Complex_2_in_triangulation_3.h>
#include <CGAL/IO/facets_in_complex_2_to_triangle_mesh.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/make_surface_mesh.h>
#include <fmt/format.h>

#include <set>

#include "geometry/meshing/cgal_mesh.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/mesh/triangle_surface.hpp"

namespace tack {
namespace {

using Triangulation = CGAL::Surface_mesh_default_triangulation_3;
using Traits = Triangulation::Geom_traits;
using SolidFace = CGAL::AABB_face_graph_triangle_primitive<CgalMesh>;
using SolidTree = CGAL::AABB_tree<CGAL::AABB_traits<CgalKernel, SolidFace>>;

// Implicit function of the offset surface: negative inside.
class Depth {
 public:
  Depth(const CgalMesh& mesh, double distance) : tree_(faces(mesh).begin(), faces(mesh).end(), mesh), side_(tree_), distance_(distance) {
    tree_.accelerate_distance_queries();
  }

  double operator()(const CgalPoint& p) const {
    const double away = std::sqrt(tree_.squared_distance(p));
    // The side is found only where the sign depends on it.
    if (away <= std::abs(distance_)) return distance_ > 0 ? away - distance_ : -away - distance_;
    const bool inside = side_(p) == CGAL::ON_BOUNDED_SIDE;
    return (inside ? -away : away) - distance_;
  }

 private:
  SolidTree tree_;
  CGAL::Side_of_triangle_mesh<CgalMesh, CgalKernel> side_;
  double distance_;
};

struct DepthAt {
  const Depth* depth;
  double operator()(const Traits::Point_3& p) const { return (*depth)(CgalPoint(p.x(), p.y(), p.z())); }
};

// Returns points on the offset surface over triangles of the old one, at least `spacing` apart, so that no component is missed.
std::vector<Vec3> points_on_offset(const Mesh& surface, const Depth& depth, double distance, double spacing) {
  std::vector<Vec3> points;
  std::set<std::array<long, 3>> taken;
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3 &x = surface.vertices[a], &y = surface.vertices[b], &z = surface.vertices[c];
    const Vec3 over = (x + y + z) / 3 + distance * (y - x).cross(z - x).normalized();
    if (std::abs(depth(cgal_point(over))) > 1e-9 * std::abs(distance)) continue;  // another triangle is closer
    const Vec3 cell = (over / spacing).array().floor();
    if (taken.insert({std::lround(cell[0]), std::lround(cell[1]), std::lround(cell[2])}).second) points.push_back(over);
  }
  return points;
}

}  // namespace

Mesh offset(const Mesh& mesh, const OffsetOptions& o, const std::string& name, Notes& notes) {
  const Mesh surface = triangle_surface(mesh, name);
  require_solid(surface, name);
  refuse_too_short_edges(surface, o.edge_length, name);
  const CgalMesh m = to_cgal(surface);
  const Depth depth(m, o.distance);
  const double deviation = o.deviation.value_or(0.05 * o.edge_length);
  const std::vector<Vec3> start = points_on_offset(surface, depth, o.distance, o.edge_length / 2);
  if (start.empty())
    throw InputError(fmt::format("{}: nothing of the surface is {:.4g} m inside; offset by less", name, -o.distance));
  const auto box = bounding_box(surface);
  const Vec3 centre = box.center();
  const double radius = box.diagonal().norm() / 2 + 2 * std::abs(o.distance) + o.edge_length;
  const Traits::Sphere_3 sphere(Traits::Point_3(centre[0], centre[1], centre[2]), radius * radius);
  const CGAL::Implicit_surface_3<Traits, DepthAt> implicit(DepthAt{&depth}, sphere, 0.01 * deviation / radius);
  Triangulation triangulation;
  for (const Vec3& x : start) triangulation.insert(Traits::Point_3(x[0], x[1], x[2]));
  CGAL::Complex_2_in_triangulation_3<Triangulation> complex(triangulation);
  const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(25, 0.8 * o.edge_length, deviation);
  CGAL::make_surface_mesh(complex, implicit, criteria, CGAL::Manifold_tag(), 0);
  CgalMesh out;
  CGAL::facets_in_complex_2_to_triangle_mesh(complex, out);
  Mesh result = from_cgal(out);
  if (result.triangles.empty()) throw InputError(name + ": no triangle came out; ask for shorter edges");
  notes.push_back(fmt::format("offset by {:.4g} m: {} triangles, now {}", o.distance, surface.triangles.size(), result.triangles.size()));
  return result;
}

}  // namespace tack
