#include "geometry/meshing/simplify.hpp"

#include <CGAL/number_utils.h>  // first: the next header uses it without including it

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fmt/format.h>

#include "geometry/meshing/cgal_mesh.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/mesh/triangle_surface.hpp"

namespace tack {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;

struct FewEnough {
  const CgalMesh& mesh;
  std::size_t triangles;
  template <class... Arguments>
  bool operator()(const Arguments&...) const {
    return mesh.number_of_faces() <= triangles;
  }
};

}  // namespace

Mesh simplify(const Mesh& mesh, int triangles, const std::string& name, Notes& notes) {
  const Mesh surface = triangle_surface(mesh, name);
  require_oriented_manifold(surface, name);
  CgalMesh m = to_cgal(surface);
  const sms::Bounded_normal_change_placement<sms::LindstromTurk_placement<CgalMesh>> placement;
  sms::edge_collapse(m, FewEnough{m, static_cast<std::size_t>(triangles)}, CGAL::parameters::get_placement(placement));
  notes.push_back(fmt::format("{} triangles simplified to {}", surface.triangles.size(), m.number_of_faces()));
  if (m.number_of_faces() > static_cast<std::size_t>(triangles))
    notes.push_back(fmt::format("warning: {} triangles are left, more than the {} asked for: no edge can be collapsed any more "
                                "without turning a triangle over", m.number_of_faces(), triangles));
  return from_cgal(m);
}

}  // namespace tack
