#include "geometry/meshing/remesh.hpp"

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/meshing/cgal_mesh.hpp"
#include "geometry/errors.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/triangle_surface.hpp"
#include "geometry/meshing/mesh_warnings.hpp"

namespace tack {
namespace {

constexpr double degree = std::numbers::pi / 180, flat = std::numbers::pi;  // rad
constexpr double tolerated_change = 0.1;  // of the area, relative

struct Remeshed {
  CgalMesh mesh;
  long creases;  // edges that were kept
};

Remeshed remeshed(CgalMesh m, const RemeshOptions& o, double crease_angle) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  const auto crease = m.add_property_map<CgalMesh::Edge_index, bool>("e:crease", false).first;
  pmp::detect_sharp_edges(m, crease_angle / degree, crease);
  const long creases = std::count_if(m.edges().begin(), m.edges().end(), [&](auto e) { return crease[e]; });
  const auto keep = CGAL::parameters::edge_is_constrained_map(crease);
  pmp::isotropic_remeshing(m.faces(), o.edge_length, m,
                           keep.number_of_iterations(o.iterations).number_of_relaxation_steps(3).relax_constraints(true));
  return {std::move(m), creases};
}

// Throws InputError for edges longer than the surface, which would not preserve its shape: a ball would become a tetrahedron.
void refuse_too_long_edges(const Mesh& mesh, double edge_length, const std::string& name) {
  const double size = bounding_box(mesh).diagonal().norm();
  if (edge_length <= size) return;
  throw InputError(fmt::format("{}: edges of {:.4g} m are longer than the surface, which is {:.4g} m large: next to nothing of its shape would be left; give a shorter "
                               "edge_length, with its unit (edge_length=5mm), or scale the mesh", name, edge_length, size));
}

// Returns the number of edges in which the surface folds back on itself.
long folds(const CgalMesh& m) {
  return std::count_if(m.edges().begin(), m.edges().end(), [&](auto e) {
    const auto h = m.halfedge(e);
    if (m.is_border(e)) return false;
    const auto corner = [&](auto half) -> const CgalPoint& { return m.point(m.target(half)); };
    const CgalPoint &a = m.point(m.source(h)), &b = corner(h);
    const auto u = CGAL::cross_product(b - a, corner(m.next(h)) - a), v = CGAL::cross_product(corner(m.next(m.opposite(h))) - a, b - a);
    return u * v < -0.87 * std::sqrt(u.squared_length() * v.squared_length());  // by more than 150 degrees
  });
}

}  // namespace

Mesh remesh(const Mesh& mesh, const RemeshOptions& o, const std::string& name, Notes& notes) {
  const Mesh surface = triangle_surface(mesh, name);
  require_oriented_manifold(surface, name);
  refuse_too_short_edges(surface, o.edge_length, name);
  refuse_too_long_edges(surface, o.edge_length, name);
  const CgalMesh given = to_cgal(surface);
  // On a coarse smooth surface, some edges count as creases. Kept edges that end inside the surface make it fold around them. Then the
  // bluntest ones are given up.
  double crease_angle = o.crease_angle;
  Remeshed made = remeshed(given, o, crease_angle);
  for (const long before = folds(given); folds(made.mesh) > before && crease_angle < flat; made = remeshed(given, o, crease_angle))
    crease_angle = std::min(crease_angle + 15 * degree, flat);
  notes.push_back(fmt::format("{} triangles remeshed to {}, {} edges on creases kept", surface.triangles.size(),
                              made.mesh.number_of_faces(), made.creases));
  Mesh result = from_cgal(made.mesh);
  if (const double change = total_area(result) / total_area(surface) - 1; std::abs(change) > tolerated_change)
    notes.push_back(fmt::format("{}{:.3g} % {} than before: edges of {:.3g} m are long for its shape; ask for shorter ones", mesh_warning::changed_area, 100 * std::abs(change),
                                change < 0 ? "smaller" : "larger", o.edge_length));
  if (crease_angle > o.crease_angle)
    notes.push_back(fmt::format("{}{:.3g} degrees are not kept, as the surface folded between them; ask for "
                                "shorter edges if they are meant, or raise crease_angle", mesh_warning::lost_edges, crease_angle / degree));
  return result;
}

}  // namespace tack
