#include "geometry/meshing/booleans.hpp"

#include <CGAL/Polygon_mesh_processing/clip.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <fmt/format.h>

#include "geometry/mesh/cleanup.hpp"
#include "geometry/meshing/cgal_mesh.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/mesh/triangle_surface.hpp"

namespace tack {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

CgalMesh solid(const Mesh& mesh, const std::string& name) {
  const Mesh surface = triangle_surface(mesh, name);
  require_solid(surface, name);
  CgalMesh result = to_cgal(surface);
  if (!pmp::does_bound_a_volume(result))
    throw InputError(name + ": its closed components are not oriented as the border of a solid: each has to have its normals outwards, "
                     "a hollow inwards; repair it (`tack mesh repair`)");
  return result;
}

bool corefine(Boolean kind, CgalMesh& a, CgalMesh& b, CgalMesh& out) {
  switch (kind) {
    case Boolean::unite:
      return pmp::corefine_and_compute_union(a, b, out);
    case Boolean::subtract:
      return pmp::corefine_and_compute_difference(a, b, out);
    case Boolean::intersect:
      return pmp::corefine_and_compute_intersection(a, b, out);
  }
  return false;
}

// Returns the result with new vertices merged within round-off, if it then is still a closed manifold.
Mesh result_of(const CgalMesh& m, const std::string& name) {
  if (m.number_of_faces() == 0) throw InputError(name + ": nothing is left; move or scale one of the two");
  const Mesh exact = from_cgal(m);
  Mesh merged = exact;
  merge_duplicate_vertices(merged, 1e-12 * bounding_box(exact).diagonal().norm());
  const SurfaceDefects defects = find_defects(merged, false);
  return defects.closed() && defects.manifold() && defects.flipped.empty() ? merged : exact;
}

// Adds a warning for defects: where surfaces nearly touch, rounding may make triangles cross or degenerate.
void warn_of_rounding(const Mesh& result, Notes& notes) {
  const SurfaceDefects defects = find_defects(result);
  if (defects.bounds_volume()) return;
  notes.push_back("warning: the surfaces nearly touch; rounded to doubles, the result has defects, to be mended by the step repair:");
  for (const std::string& line : list_defects(defects)) notes.push_back("  " + line);
}

}  // namespace

Mesh boolean(Boolean kind, const Mesh& a, const Mesh& b, const std::string& name_a, const std::string& name_b, Notes& notes) {
  CgalMesh first = solid(a, name_a), second = solid(b, name_b), out;
  const std::size_t before = first.number_of_faces() + second.number_of_faces();
  if (!corefine(kind, first, second, out))
    throw InputError(fmt::format("{}: the result with {} would touch itself in an edge or a vertex, and be no manifold; move one "
                                 "of them by a small amount", name_a, name_b));
  Mesh result = result_of(out, name_a);
  notes.push_back(fmt::format("{} triangles of both give {}", before, result.triangles.size()));
  warn_of_rounding(result, notes);
  return result;
}

Mesh cut(const Mesh& mesh, const Vec3& point, const Vec3& normal, const std::string& name, Notes& notes) {
  if (!(normal.norm() > 0)) throw InputError(name + ": the normal of a cut needs a length above zero");
  CgalMesh m = solid(mesh, name);
  const std::size_t before = m.number_of_faces();
  const Vec3 n = normal.normalized();
  const CgalKernel::Plane_3 plane(cgal_point(point), CgalKernel::Vector_3(n[0], n[1], n[2]));
  if (!pmp::clip(m, plane, CGAL::parameters::clip_volume(true)))
    throw InputError(name + ": the cut would leave a surface that touches itself; move the plane by a small amount");
  Mesh result = result_of(m, name);
  notes.push_back(fmt::format("{} triangles, {} after the cut", before, result.triangles.size()));
  warn_of_rounding(result, notes);
  return result;
}

}  // namespace tack
