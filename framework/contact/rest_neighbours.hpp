// What is close already at rest in one object does not press: a body alone is without stress. Particles are bodies of
// their own.
#pragma once

#include "framework/contact/contact_set.hpp"
#include "geometry/distance/box_gap.hpp"
#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/point_edge.hpp"
#include "geometry/distance/point_triangle.hpp"

namespace tack {

// Squared [m^2]; of a point and a point, edge or triangle, or of two edges.
inline double squared_distance(const std::array<Vec3, 1>& a, const std::array<Vec3, 1>& b) { return (a[0] - b[0]).squaredNorm(); }
inline double squared_distance(const std::array<Vec3, 1>& a, const std::array<Vec3, 2>& b) {
  return point_edge_distance(a[0], b[0], b[1]);
}
inline double squared_distance(const std::array<Vec3, 1>& a, const std::array<Vec3, 3>& b) {
  return point_triangle_distance(a[0], b[0], b[1], b[2]);
}
inline double squared_distance(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
  return edge_edge_distance(a[0], a[1], b[0], b[1]);
}

// Whether two primitives (global vertices) of one object are closer than range [m] at rest.
template <size_t A, size_t B>
bool rest_neighbours(const ContactSurface& surface, const std::array<int, A>& a, const std::array<int, B>& b, double range) {
  if (surface.mesh.vertex_object[a[0]] != surface.mesh.vertex_object[b[0]] || surface.is_particle(a) || surface.is_particle(b))
    return false;
  const auto ca = corners(surface.rest, a);
  const auto cb = corners(surface.rest, b);
  return box_gaps(ca, cb).maxCoeff() < range && squared_distance(ca, cb) < range * range;
}

}  // namespace tack
