// Anchor of a bond while its place slides along the anchor's surface: the triangle that the place
// faces, the end of that surface, and an anchor moved closer to the place, as what heals is
// unstressed.
#pragma once

#include <optional>

#include "framework/bond/bond.hpp"
#include "framework/contact/surface_topology.hpp"

namespace tack {

// Returns the triangle that holds the projection of p onto the surface of the triangle `from`. The
// search starts there and crosses smooth edges only (surface_topology.hpp). Returns none if p lies
// beyond the boundary or a crease of the surface.
std::optional<int> facing_triangle(const SurfaceTopology& topology, const CollisionMesh& mesh,
                                   const VecX& x, int from, const Vec3& p);

// Returns the position of the bond's place at x [m].
Vec3 place_at(const Bond& bond, const VecX& x);

// Leaves the fraction `kept` of the slip and of an opening above zero. Moves the anchor's point of
// the interface towards the place's, and with it anchor and lever. The frame must be that of x.
void renew_anchor(Bond& bond, const SurfaceTopology& topology, const CollisionMesh& mesh,
                  const VecX& x, double kept);

}  // namespace tack
