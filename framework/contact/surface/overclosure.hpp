// Initial overclosures: pairs of primitives that touch or are closer than the offset of their
// objects, so that their contact surfaces intersect.
#pragma once

#include <vector>

#include "framework/contact/contact_system.hpp"

namespace tack {

struct Overclosure {
  std::vector<int> first, second;  // global vertices of both primitives
  double distance, offset;         // m
  bool touching;                   // within rounding errors
  Vec3 at;                         // closest point on the first primitive [m]
};

// Returns the first few overclosures among the candidates, which must cover x. Within one object
// the offset is reduced by the rest gap (rest_gaps.hpp).
std::vector<Overclosure> find_overclosures(const ContactSystem& contact, const VecX& x);

}  // namespace tack
