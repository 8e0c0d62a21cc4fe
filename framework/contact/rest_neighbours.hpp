// What is close already at rest in one object does not press: a body alone is without stress. Particles are bodies of
// their own.
#pragma once

#include "framework/contact/contact_set.hpp"
#include "geometry/distance/box_gap.hpp"
#include "geometry/distance/squared_distance.hpp"

namespace tack {

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
