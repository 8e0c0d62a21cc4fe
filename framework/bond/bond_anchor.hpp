// The anchor of a bond while its place slides along the anchor's surface: which triangle the place
// faces, where that surface ends for it, and an anchor that is taken closer to the place, as what heals
// is unstressed.
#pragma once

#include <optional>

#include "framework/bond/bond.hpp"
#include "framework/contact/surface_topology.hpp"

namespace tack {

// The triangle that holds the projection of p onto the surface of the triangle `from`, found from there
// over smooth edges (surface_topology.hpp); none if p lies beyond the boundary or a crease of it.
std::optional<int> facing_triangle(const SurfaceTopology& topology, const CollisionMesh& mesh,
                                   const VecX& x, int from, const Vec3& p);

// The place of the bond at x.
Vec3 place_at(const Bond& bond, const VecX& x);

// Leaves the share `kept` of the slip and of an opening above zero: moves the anchor's point of the
// interface towards the place's, and with it anchor and lever. The frame must be that of x.
void renew_anchor(Bond& bond, const SurfaceTopology& topology, const CollisionMesh& mesh,
                  const VecX& x, double kept);

}  // namespace tack
