#include "geometry/meshing/triangulate.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "geometry/errors.hpp"
#include "geometry/mesh/triangle_surface.hpp"

namespace tack {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<CGAL::Delaunay_mesh_vertex_base_2<Kernel>, CGAL::Delaunay_mesh_face_base_2<Kernel>>>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;

constexpr double shape_bound = 0.125;  // squared sine of the smallest angle

}  // namespace

FlatMesh triangulate(const std::vector<Vec2>& polygon, double edge_length, const std::string& name) {
  std::vector<Kernel::Point_2> corners;
  for (const Vec2& p : polygon) corners.emplace_back(p.x(), p.y());
  if (corners.size() < 3) throw InputError(name + ": a closed profile needs three corners or more");
  if (!CGAL::is_simple_2(corners.begin(), corners.end(), Kernel()))
    throw InputError(name + ": the sides of the closed profile cross or touch each other; give its corners in their order around it");
  const double area = std::abs(CGAL::polygon_area_2(corners.begin(), corners.end(), Kernel()));
  refuse_too_many_triangles(4 * area / (edge_length * edge_length), name, "use fewer cells, or longer edges");
  Triangulation t;
  std::map<Triangulation::Vertex_handle, int> number;
  FlatMesh mesh;
  std::vector<Triangulation::Vertex_handle> vertices;
  for (const auto& p : corners) {
    vertices.push_back(t.insert(p));
    number[vertices.back()] = static_cast<int>(mesh.vertices.size());
    mesh.vertices.emplace_back(p.x(), p.y());
  }
  for (size_t i = 0; i < vertices.size(); ++i) t.insert_constraint(vertices[i], vertices[(i + 1) % vertices.size()]);
  CGAL::refine_Delaunay_mesh_2(t, Criteria(shape_bound, edge_length));
  for (auto v = t.finite_vertices_begin(); v != t.finite_vertices_end(); ++v) {
    if (!number.try_emplace(v, static_cast<int>(mesh.vertices.size())).second) continue;
    mesh.vertices.emplace_back(v->point().x(), v->point().y());
  }
  for (auto f = t.finite_faces_begin(); f != t.finite_faces_end(); ++f)
    if (f->is_in_domain()) mesh.triangles.push_back({number.at(f->vertex(0)), number.at(f->vertex(1)), number.at(f->vertex(2))});
  return mesh;
}

}  // namespace tack
