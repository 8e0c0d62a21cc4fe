#include "framework/world/hulls.hpp"

#include "framework/body/local_mesh.hpp"
#include "geometry/mesh/overlap_depth.hpp"

namespace tack {
namespace {

bool may_be_hull(const Body& body) {
  return !body.movable && body.frame.empty() && body.tets.empty() && !body.sheet.empty() && body.edges.empty() && body.points.empty() &&
         body.thickness == 0;
}

// Returns whether the hull encloses a vertex of the other object. Surfaces do not intersect, so that
// a connected component lies on the side of each of its vertices.
bool encloses(const SurfaceDistance& hull, const World& world, const Body& other) {
  const double search_radius = (hull.box().hi - hull.box().lo).norm();
  for (int v = other.first_vertex; v < other.first_vertex + other.vertex_count; ++v) {
    const Vec3 at = vertex(world.rest, v);
    if ((at.array() < hull.box().lo.array()).any() || (at.array() > hull.box().hi.array()).any()) continue;
    if (const auto closest = hull.at(at, search_radius); closest && closest->distance < 0) return true;
  }
  return false;
}

}  // namespace

std::vector<char> find_hulls(const World& world) {
  std::vector<char> hulls(world.bodies.size(), 0);
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    if (!may_be_hull(body)) continue;
    const SurfaceDistance surface(local_mesh(body, world.rest));
    if (!surface.closed()) continue;
    hulls[i] = 1;
    for (size_t k = 0; k < world.bodies.size() && hulls[i]; ++k)
      if (k != i && encloses(surface, world, world.bodies[k])) hulls[i] = 0;
  }
  return hulls;
}

}  // namespace tack
