#include "framework/contact/area_integral/own_boundary.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/distance/barycentric_slopes.hpp"

namespace tack {
namespace {

// Largest cosine between the way and an edge that bounds it: cos 75 degrees. Boundaries that cross at
// larger angles do not pass each other along their length.
constexpr double edge_cosine_max = 0.2588;

// Returns another triangle at the edge from u to v that faces a surface of the given normal; -1: none.
int triangle_beyond(const CollisionMesh& mesh, const LaggedSurface& lagged, int triangle, int u, int v, const Vec3& facing) {
  for (const int t : lagged.topology().triangles_at(u)) {
    const Triangle& corners = mesh.triangles[t];
    if (t != triangle && std::find(corners.begin(), corners.end(), v) != corners.end() && lagged.cosine(t, facing) > facing_cosine_min) return t;
  }
  return -1;
}

}  // namespace

double way_to_boundary(const CollisionMesh& mesh, const LaggedSurface& lagged, SurfacePoint from, const Vec3& direction, const Vec3& facing, double limit) {
  double way = 0;
  int came_from = -1;  // corner opposite to the edge through which the way entered the triangle
  while (way <= limit) {
    const Triangle& t = mesh.triangles[from.triangle];
    const std::array<Vec3, 3> slopes = barycentric_slopes(corners(lagged.x(), t));
    int opposite = -1;
    double length = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const double rate = direction.dot(slopes[i]);
      if (i == came_from || rate >= 0) continue;
      if (const double to_edge = std::max(0.0, from.inside[i]) / -rate; to_edge < length) length = to_edge, opposite = i;
    }
    if (opposite < 0) return way;  // folded back
    way += length;
    const int u = t[(opposite + 1) % 3], v = t[(opposite + 2) % 3];
    const int next = triangle_beyond(mesh, lagged, from.triangle, u, v, facing);
    if (next < 0) {
      const Vec3 edge = (vertex(lagged.x(), v) - vertex(lagged.x(), u)).normalized();
      return std::abs(edge.dot(direction)) <= edge_cosine_max ? way : std::numeric_limits<double>::infinity();
    }
    const double at_v = std::clamp(from.inside[(opposite + 2) % 3] + length * direction.dot(slopes[(opposite + 2) % 3]), 0.0, 1.0);
    from = {next, Vec3::Zero()};
    for (int i = 0; i < 3; ++i) {
      const int corner = mesh.triangles[next][i];
      if (corner == u) from.inside[i] = 1 - at_v;
      else if (corner == v) from.inside[i] = at_v;
      else came_from = i;
    }
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace tack
