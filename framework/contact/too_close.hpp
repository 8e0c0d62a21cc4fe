// Pairs of primitives that are closer than the offset of their objects: whose contact surfaces intersect.
#pragma once

#include <vector>

#include "framework/contact/contact_system.hpp"

namespace tack {

struct TooClose {
  std::vector<int> first, second;  // global vertices of both
  double distance, offset;         // m
};

// The first few among the candidates, which must cover x; parts of one object that are close at rest are none.
std::vector<TooClose> find_too_close(const ContactSystem& contact, const VecX& x);

}  // namespace tack
