// Gradient noise on a lattice (Perlin 1985, with the fade function of his 2002 paper): zero mean,
// within -1 and 1, gradient at most gradient_noise_slope. The same on every machine.
#pragma once

#include <cstdint>

#include "geometry/types.hpp"

namespace tack {

// Returns the noise at a point in units of the lattice.
double gradient_noise(const Vec3& p, std::uint32_t seed);

// Bound of the gradient, above all values found in tests/geometry/level_set.
inline constexpr double gradient_noise_slope = 3.6;

}  // namespace tack
