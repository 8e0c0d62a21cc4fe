// Intersections of two sets of tets.
#pragma once

#include <array>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

// Returns the volume of the intersection of two positive tets [m^3], up to rounding; 0 if they only
// touch.
double shared_volume(const std::array<Vec3, 4>& a, const std::array<Vec3, 4>& b);

struct TetOverlap {
  int one, other;  // indices of tets
  double volume;   // m^3
};

// Returns the intersections of each of `ones` with each of `others`, sorted by `one`, then `other`.
std::vector<TetOverlap> tet_overlaps(const std::vector<std::array<Vec3, 4>>& ones,
                                     const std::vector<std::array<Vec3, 4>>& others);

}  // namespace tack
