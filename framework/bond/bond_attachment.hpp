// Attachment point of a bond whose site slides along the opposite surface: the triangle that the
// site faces, the boundary of that surface, and the attachment point of a healed bond. A bond heals
// without stress, so its attachment point moves towards the site.
#pragma once

#include <optional>

#include "framework/bond/bond.hpp"
#include "framework/contact/surface/surface_topology.hpp"

namespace tack {

/// Returns the triangle that contains the projection of p onto the surface of the triangle `from`.
/// The search starts there and crosses smooth edges only (surface_topology.hpp). Returns nothing if
/// p lies beyond the boundary or a crease of the surface.
std::optional<int> facing_triangle(const SurfaceTopology& topology, const CollisionMesh& mesh,
                                   const VecX& x, int from, const Vec3& p);

/// Returns the position of the bond site at x [m].
Vec3 site_position(const Bond& bond, const VecX& x);

/// Moves the attachment point and its lever towards the site, so that the fraction `kept` of the
/// slip and of a positive opening is left. The frame of the bond must be that of x.
void move_attachment(Bond& bond, const SurfaceTopology& topology, const CollisionMesh& mesh,
                     const VecX& x, double kept);

}  // namespace tack
