// How far around each object the candidates of contact are searched for.
//
// Key idea: ranges are of pairs, and boxes are of objects; half of the largest range of all for each would be far too much where few objects adhere and many
// only touch. So each object reaches half of the smallest range that it has with any other, and what a pair lacks then, the one of the two with fewer
// surface vertices reaches further.
#pragma once

#include "framework/contact/contact_set.hpp"
#include "framework/contact/pair_table.hpp"
#include "geometry/broad_phase/reaches.hpp"

namespace tack {

// Any pair of objects reaches at least the ranges of all of its laws together.
Reaches pair_reaches(const ContactSurface& surface, const PairTable& pairs);

}  // namespace tack
