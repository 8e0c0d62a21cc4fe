// Tractions of bonds: gradients of their laws by the separation r, per area [Pa].
#pragma once

#include "framework/bond/bond.hpp"
#include "framework/bond/bond_law.hpp"

namespace tack {

inline Vec3 traction(const BondSample& s, const Bond& bond, const Opening& o) {
  return s.by_d * bond.normal + 2 * s.by_s * o.u;
}

// Returns the interface frame of a site as columns: normal and tangents.
inline Mat3 frame_of(const Bond& bond, const SiteState& site) {
  return (Mat3() << bond.normal, site.tangents[0], site.tangents[1]).finished();
}

// Returns the traction of a directed law. frame: frame_of() its site.
inline Vec3 traction(const DirectedSample& s, const Mat3& frame) { return frame * s.gradient; }

}  // namespace tack
