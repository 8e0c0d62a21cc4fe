// Primitives of one object that are close to each other at rest (rest_gaps.hpp). Each particle
// counts as an object of its own.
#pragma once

#include "framework/contact/surface/rest_gaps.hpp"
#include "geometry/distance/box_gap.hpp"
#include "geometry/distance/squared_distance.hpp"

namespace tack {

// Returns whether two primitives (global vertices) of one object are closer than range [m] at rest.
template <size_t A, size_t B>
bool close_at_rest(const ContactSurface& surface, const std::array<int, A>& a,
                   const std::array<int, B>& b, double range) {
  if (surface.mesh.vertex_object[a[0]] != surface.mesh.vertex_object[b[0]] ||
      surface.is_particle(a) || surface.is_particle(b))
    return false;
  const auto ca = corners(surface.rest, a);
  const auto cb = corners(surface.rest, b);
  return box_gaps(ca, cb).maxCoeff() < range && squared_distance(ca, cb) < range * range;
}

// Returns whether two primitives are close at rest without a gap between them. Such neighbours do
// not press.
template <size_t A, size_t B>
bool rest_neighbours(const ContactSurface& surface, const std::array<int, A>& a,
                     const std::array<int, B>& b, double range) {
  return close_at_rest(surface, a, b, range) &&
         !(surface.rest_gaps && surface.rest_gaps->gap_between(a, b));
}

// Returns the offset of two primitives [m]: that of their objects; within one object the reduced
// offset, 0 between neighbours.
template <size_t A, size_t B>
double offset_between(const ContactSurface& surface, const PairTable& pairs,
                      const std::array<int, A>& a, const std::array<int, B>& b) {
  const int object = surface.mesh.vertex_object[a[0]], other = surface.mesh.vertex_object[b[0]];
  const double offset = pairs.offset(object, other);
  if (offset == 0 || object != other || surface.is_particle(a) || surface.is_particle(b))
    return offset;
  if (rest_neighbours(surface, a, b, pairs.edge(object, object).range)) return 0;
  return surface.rest_gaps ? surface.rest_gaps->offset(offset, a, b) : offset;
}

}  // namespace tack
