#include "framework/contact/area_integral/polygon_clip.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/distance/point_triangle.hpp"

namespace tack {
namespace {

constexpr double same_direction = 1e-12, same_place = 1e-9;  // relative to the length of an edge

void add_line(const CollisionMesh& mesh, const LaggedSurface& lagged, int triangle, int side, std::vector<ClipLine>& lines) {
  const Triangle& t = mesh.triangles[triangle];
  const Vec3 at = vertex(lagged.x(), t[side]), along = Vec3(vertex(lagged.x(), t[(side + 1) % 3])) - at;
  const ClipLine line{triangle, side, at, along.cross(lagged.normal(triangle)).normalized()};
  const bool known = std::any_of(lines.begin(), lines.end(), [&](const ClipLine& l) {
    return l.outward.dot(line.outward) > 1 - same_direction && std::abs((l.at - at).dot(l.outward)) < same_place * along.norm();
  });
  if (!known) lines.push_back(line);
}

}  // namespace

void add_clip_lines(const CollisionMesh& mesh, const LaggedSurface& lagged, const SurfaceRegion* region, int triangle, const Vec3& p,
                    std::vector<ClipLine>& lines) {
  const Triangle& t = mesh.triangles[triangle];
  const PointTriangleType type =
      point_triangle_type(p, vertex(lagged.x(), t[0]), vertex(lagged.x(), t[1]), vertex(lagged.x(), t[2]));
  const int feature = static_cast<int>(type);  // three vertices, three edges, the face
  const SurfaceTopology& topology = lagged.topology();
  if (feature >= 6) return;
  const auto goes_on = [&](int of, int side) { return topology.smooth_edge(of, side) && (!region || region->surrounds_edge(topology, of, side)); };
  if (feature >= 3) {
    if (!goes_on(triangle, feature - 3)) add_line(mesh, lagged, triangle, feature - 3, lines);
    return;
  }
  const int corner = t[feature];
  for (const int near : topology.triangles_at(corner)) {
    if (!(lagged.normal(near).dot(lagged.normal(triangle)) > facing_cosine_min) || (region && !region->contains(near))) continue;
    for (int side = 0; side < 3; ++side) {
      const bool at_corner = mesh.triangles[near][side] == corner || mesh.triangles[near][(side + 1) % 3] == corner;
      if (at_corner && !goes_on(near, side)) add_line(mesh, lagged, near, side, lines);
    }
  }
}

std::vector<ClipPolygon> clip_by_lines(const VecX& x, const Triangle& own, const std::array<Vec3, 3>& subtriangle,
                                       const std::vector<ClipLine>& lines) {
  std::vector<ClipPolygon> clipped = {{{subtriangle[0], -1, false}, {subtriangle[1], -1, false}, {subtriangle[2], -1, false}}}, polygons;
  for (int k = 0; k < static_cast<int>(lines.size()); ++k) {
    const auto height = [&](const Vec3& inside) { return (point_inside(x, own, inside) - lines[k].at).dot(lines[k].outward); };
    polygons.clear();
    for (const ClipPolygon& polygon_before : clipped) {
      ClipPolygon inside, outside;
      for (size_t i = 0; i < polygon_before.size(); ++i) {
        const ClipCorner &p = polygon_before[i], &q = polygon_before[(i + 1) % polygon_before.size()];
        const double from = height(p.inside), to = height(q.inside);
        (from <= 0 ? inside : outside).push_back(p);
        if ((from <= 0) == (to <= 0)) continue;
        const Vec3 at = p.inside + from / (from - to) * (q.inside - p.inside);
        // The polygon that the boundary leaves continues along the line; the polygon that it enters
        // continues along the old edge.
        ClipPolygon &left = from <= 0 ? inside : outside, &entered = from <= 0 ? outside : inside;
        left.push_back({at, k, from > 0});
        entered.push_back({at, p.line, p.outside});
      }
      for (ClipPolygon* polygon : {&inside, &outside})
        if (polygon->size() > 2) polygons.push_back(std::move(*polygon));
    }
    std::swap(clipped, polygons);
  }
  return clipped;
}

}  // namespace tack
