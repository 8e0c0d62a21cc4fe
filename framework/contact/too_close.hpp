// Pairs of primitives that touch, or are closer than the offset of their objects: whose contact surfaces intersect.
#pragma once

#include <vector>

#include "framework/contact/contact_system.hpp"

namespace tack {

struct TooClose {
  std::vector<int> first, second;  // global vertices of both
  double distance, offset;         // m
  bool touching;                   // at `at`, as far as numbers tell
  Vec3 at;                         // m, on the first
};

// Returns the first few such pairs among the candidates, which must cover x. Within one object the
// offset is what remains of it (rest_gaps.hpp).
std::vector<TooClose> find_too_close(const ContactSystem& contact, const VecX& x);

}  // namespace tack
