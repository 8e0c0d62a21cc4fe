// Smooth noise without a preferred direction at points of a lattice (Perlin 1985, with the fade of
// his 2002 paper): of zero mean, within -1 and 1, its gradient no longer than gradient_noise_slope.
// The same on every machine.
#pragma once

#include <cstdint>

#include "geometry/types.hpp"

namespace tack {

// At a point in units of the lattice.
double gradient_noise(const Vec3& p, std::uint32_t seed);

inline constexpr double gradient_noise_slope = 3.6;  // above what is met (tests/geometry/level_set)

}  // namespace tack
