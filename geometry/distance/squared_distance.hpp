// Squared distance [m^2] between a point and a point, edge or triangle, or between two edges.
#pragma once

#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/point_edge.hpp"
#include "geometry/distance/point_triangle.hpp"

namespace tack {

inline double squared_distance(const std::array<Vec3, 1>& a, const std::array<Vec3, 1>& b) {
  return (a[0] - b[0]).squaredNorm();
}
inline double squared_distance(const std::array<Vec3, 1>& p, const std::array<Vec3, 2>& e) {
  return point_edge_distance(p[0], e[0], e[1]);
}
inline double squared_distance(const std::array<Vec3, 1>& p, const std::array<Vec3, 3>& t) {
  return point_triangle_distance(p[0], t[0], t[1], t[2]);
}
inline double squared_distance(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
  return edge_edge_distance(a[0], a[1], b[0], b[1]);
}

}  // namespace tack
