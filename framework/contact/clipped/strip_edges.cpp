#include "framework/contact/clipped/strip_edges.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace tack {
namespace {

// Returns |tan| of the angle between two edges; no bound if they are perpendicular.
double tangent_of(const Vec3& e, const Vec3& f) {
  return e.cross(f).norm() / std::abs(e.dot(f));
}

}  // namespace

StripEdges::StripEdges(const ContactSurface& surface, const SurfaceTopology& topology)
    : neighbour_(surface.mesh.triangles.size(), {-1, -1, -1}),
      half_height_(surface.mesh.triangles.size()), ratio_(surface.mesh.triangles.size()) {
  for_each_edge(surface, [&](std::span<const EdgeUse> uses, const std::optional<double>& angle) {
    if (!angle) return;
    neighbour_[uses[0].triangle][uses[0].side] = uses[1].triangle;
    neighbour_[uses[1].triangle][uses[1].side] = uses[0].triangle;
  });
  for (int t = 0; t < static_cast<int>(surface.mesh.triangles.size()); ++t) {
    const std::array<Vec3, 3> x = corners(surface.rest, surface.mesh.triangles[t]);
    const std::array<Vec3, 3> edge{x[1] - x[0], x[2] - x[1], x[0] - x[2]};
    const double twice_area = edge[0].cross(edge[1]).norm();
    for (int k = 0; k < 3; ++k) {
      half_height_[t][k] = 0.5 * twice_area / edge[k].norm();
      ratio_[t][k] = 1;
      for (const int other : {(k + 1) % 3, (k + 2) % 3})
        if (topology.smooth_edge(t, other))
          ratio_[t][k] = std::min(ratio_[t][k], tangent_of(edge[k], edge[other]));
    }
  }
}

}  // namespace tack
