// Lower bounds of the distances of several pairs of primitives, one pair in each lane [m].
//
// Key idea: for any n, the thickness of the slab between two convex hulls across n is a lower bound
// of their distance. For n between their closest points it is the distance itself. Rounding errors
// of n make the bound smaller, but it remains a lower bound. Coordinates should be relative to a
// vertex of the pair.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <limits>

#include "geometry/pack.hpp"

namespace tack {

namespace detail {

inline Pack clamped(const Pack& t) {
  const Pack low = select(t < 0, 0, t);
  return select(low < 1, low, 1);
}

// Returns a / b clamped to [0, 1]; 0 where b is 0.
inline Pack part(const Pack& a, const Pack& b) {
  const PackMask some = b > 0;
  return select(some, clamped(a / select(some, b, 1)), 0);
}

inline Pack smaller(const Pack& a, const Pack& b) { return select(a < b, a, b); }

// Returns the thickness of the slab across n, which points from b to a, less rounding errors; 0
// where n is 0.
template <size_t A, size_t B>
Pack thickness(const PackVec3& n, const std::array<PackVec3, A>& a,
               const std::array<PackVec3, B>& b) {
  Pack lowest = n.dot(a[0]), highest = n.dot(b[0]);
  for (size_t i = 1; i < A; ++i) lowest = smaller(lowest, n.dot(a[i]));
  for (size_t i = 1; i < B; ++i) highest = -smaller(-highest, -n.dot(b[i]));
  Pack size = 0;
  for (const PackVec3& x : a) size += x.squaredNorm();
  for (const PackVec3& x : b) size += x.squaredNorm();
  const Pack length = sqrt(n.squaredNorm());
  const PackMask some = length > 0;
  const Pack thick = (lowest - highest) / select(some, length, 1) -
                     16 * std::numeric_limits<double>::epsilon() * sqrt(size);
  return select(some, select(thick < 0, 0, thick), 0);
}

// Returns the vector to p from the closest point of edge b.
inline PackVec3 from_edge(const PackVec3& p, const PackVec3& b0, const PackVec3& b1) {
  const PackVec3 edge = b1 - b0, way = p - b0;
  return way - part(way.dot(edge), edge.squaredNorm()) * edge;
}

}  // namespace detail

inline Pack slab_bound(const std::array<PackVec3, 1>& a, const std::array<PackVec3, 1>& b) {
  return sqrt((a[0] - b[0]).squaredNorm());
}

inline Pack slab_bound(const std::array<PackVec3, 1>& p, const std::array<PackVec3, 2>& e) {
  return detail::thickness(detail::from_edge(p[0], e[0], e[1]), p, e);
}

// The closest points are inside both edges, or one is an end.
inline Pack slab_bound(const std::array<PackVec3, 2>& a, const std::array<PackVec3, 2>& b) {
  const PackVec3 u = a[1] - a[0], v = b[1] - b[0], w = a[0] - b[0];
  const Pack uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm(), uw = u.dot(w),
             vw = v.dot(w);
  const Pack s = detail::part(uv * vw - vv * uw, uu * vv - uv * uv);
  const Pack t = detail::part(uv * s + vw, vv);
  const Pack s_of_t = detail::part(uv * t - uw, uu);
  return detail::thickness<2, 2>(w + s_of_t * u - t * v, a, b);
}

// The closest point is the foot of the perpendicular, or on an edge.
inline Pack slab_bound(const std::array<PackVec3, 1>& p, const std::array<PackVec3, 3>& f) {
  PackVec3 nearest = detail::from_edge(p[0], f[0], f[1]);
  for (size_t i = 1; i < 3; ++i) {
    const PackVec3 n = detail::from_edge(p[0], f[i], f[(i + 1) % 3]);
    const PackMask closer = n.squaredNorm() < nearest.squaredNorm();
    for (int d = 0; d < 3; ++d) nearest(d) = select(closer, n(d), nearest(d));
  }
  const PackVec3 normal = PackVec3(f[1] - f[0]).cross(PackVec3(f[2] - f[0]));
  const PackVec3 way = p[0] - f[0];
  const Pack height = way.dot(normal);
  const Pack side = select(height < 0, Pack(-1), 1);
  const PackVec3 up = side * normal;
  const Pack by_edges = detail::thickness(nearest, p, f), by_face = detail::thickness(up, p, f);
  return -detail::smaller(-by_edges, -by_face);
}

}  // namespace tack
