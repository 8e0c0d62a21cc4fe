#include "geometry/meshing/subdivide.hpp"

#include <CGAL/subdivision_method_3.h>
#include <fmt/format.h>

#include <cmath>

#include "geometry/meshing/cgal_mesh.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/mesh/triangle_surface.hpp"

namespace tack {
namespace {

// Refinement of Loop's scheme without smoothing.
struct Flat {
  CgalMesh& mesh;
  using Vertex = CgalMesh::Vertex_index;
  using Halfedge = CgalMesh::Halfedge_index;
  void edge_node(Halfedge h, CgalPoint& p) const {
    p = CGAL::midpoint(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)));
  }
  void vertex_node(Vertex v, CgalPoint& p) const { p = mesh.point(v); }
  void border_node(Halfedge h, CgalPoint& edge, CgalPoint& vertex) const {
    edge_node(h, edge);
    vertex = mesh.point(mesh.target(h));
  }
};

}  // namespace

Mesh subdivide(const Mesh& mesh, SubdivisionRule rule, int times, const std::string& name, Notes& notes) {
  const Mesh surface = triangle_surface(mesh, name);
  require_oriented_manifold(surface, name);
  refuse_too_many_triangles(static_cast<double>(surface.triangles.size()) * std::pow(4.0, times), name, "divide fewer times");
  CgalMesh m = to_cgal(surface);
  const auto parameters = CGAL::parameters::number_of_iterations(times);
  if (rule == SubdivisionRule::loop) {
    CGAL::Subdivision_method_3::Loop_subdivision(m, parameters);
  } else {
    CGAL::Subdivision_method_3::PTQ(m, Flat{m}, parameters);
  }
  notes.push_back(fmt::format("{} triangles divided into {}", surface.triangles.size(), m.number_of_faces()));
  return from_cgal(m);
}

}  // namespace tack
