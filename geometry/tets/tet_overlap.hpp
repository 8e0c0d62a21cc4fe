// Intersections of two sets of tets.
#pragma once

#include <array>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

// The volume that two positive tets share [m^3]: 0 if they only touch. Off by rounding.
double shared_volume(const std::array<Vec3, 4>& a, const std::array<Vec3, 4>& b);

struct TetOverlap {
  int one, other;  // numbers of tets
  double volume;   // m^3
};

// Returns the intersections of each of `ones` with each of `others`, sorted by `one`, then `other`.
std::vector<TetOverlap> tet_overlaps(const std::vector<std::array<Vec3, 4>>& ones,
                                     const std::vector<std::array<Vec3, 4>>& others);

}  // namespace tack
