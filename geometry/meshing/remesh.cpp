#include "geometry/meshing/remesh.hpp"

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "geometry/meshing/cgal_mesh.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/meshing/triangle_surface.hpp"

namespace tack {

Mesh remesh(const Mesh& mesh, const RemeshOptions& o, const std::string& name, Notes& notes) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  const Mesh surface = triangle_surface(mesh, name);
  require_oriented_manifold(surface, name);
  refuse_too_short_edges(surface, o.edge_length, name);
  CgalMesh m = to_cgal(surface);
  const auto crease = m.add_property_map<CgalMesh::Edge_index, bool>("e:crease", false).first;
  pmp::detect_sharp_edges(m, o.crease_angle * 180 / std::numbers::pi, crease);
  const auto creases = std::count_if(m.edges().begin(), m.edges().end(), [&](auto e) { return crease[e]; });
  const auto keep = CGAL::parameters::edge_is_constrained_map(crease);
  pmp::isotropic_remeshing(m.faces(), o.edge_length, m,
                           keep.number_of_iterations(o.iterations).number_of_relaxation_steps(3).relax_constraints(true));
  notes.push_back(fmt::format("{} triangles remeshed to {}, {} edges on creases kept", surface.triangles.size(),
                              m.number_of_faces(), creases));
  return from_cgal(m);
}

}  // namespace tack
