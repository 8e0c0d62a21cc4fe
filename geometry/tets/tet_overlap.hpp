// What two sets of tets have in common.
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

// Of each of `ones` with each of `others`, those that share something, by `one` and then by `other`.
std::vector<TetOverlap> tet_overlaps(const std::vector<std::array<Vec3, 4>>& ones, const std::vector<std::array<Vec3, 4>>& others);

}  // namespace tack
