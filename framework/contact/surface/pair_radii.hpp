// Inflation radii of objects from the contact ranges of pairs.
//
// Key idea: contact ranges belong to pairs of objects, AABB inflation to single objects. Inflating
// every object by half of the largest range yields too many candidates where few pairs adhere and
// many only touch. Each object is therefore inflated by half of its smallest range; where a pair
// needs more, the object with fewer surface vertices is inflated further. Guarantee:
//   radius(a) + radius(b) >= range(a, b).
#pragma once

#include "framework/contact/stencils/contact_set.hpp"
#include "framework/contact/laws/pair_table.hpp"
#include "geometry/broad_phase/inflation_radii.hpp"

namespace tack {

// Returns radii for which every pair of objects is found within the ranges of all of its laws.
InflationRadii pair_radii(const ContactSurface& surface, const PairTable& pairs);

}  // namespace tack
