#include "geometry/level_set/gradient_noise.hpp"

#include <cmath>

namespace tack {
namespace {

std::uint32_t scrambled(std::uint32_t h) {
  h = (h ^ (h >> 16)) * 0x7feb352dU;
  h = (h ^ (h >> 15)) * 0x846ca68bU;
  return h ^ (h >> 16);
}

// Returns the gradient at a lattice corner, one of the twelve directions to the edges of a cube, times the offset from the corner.
double at_corner(std::int64_t i, std::int64_t j, std::int64_t k, const Vec3& offset, std::uint32_t seed) {
  std::uint32_t h = seed;
  for (const std::int64_t n : {i, j, k}) h = scrambled(h ^ static_cast<std::uint32_t>(n));
  const std::uint32_t which = h % 12;
  const int axis = static_cast<int>(which / 4);
  const double a = which & 1 ? 1 : -1, b = which & 2 ? 1 : -1;
  return a * offset[(axis + 1) % 3] + b * offset[(axis + 2) % 3];
}

double fade(double t) { return t * t * t * (t * (6 * t - 15) + 10); }

}  // namespace

double gradient_noise(const Vec3& p, std::uint32_t seed) {
  const Vec3 low = p.array().floor(), at = p - low;
  const auto i = static_cast<std::int64_t>(low.x()), j = static_cast<std::int64_t>(low.y()), k = static_cast<std::int64_t>(low.z());
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int a = corner & 1, b = corner >> 1 & 1, c = corner >> 2;
    const double weight = fade(a ? at.x() : 1 - at.x()) * fade(b ? at.y() : 1 - at.y()) * fade(c ? at.z() : 1 - at.z());
    sum += weight * at_corner(i + a, j + b, k + c, at - Vec3(a, b, c), seed);
  }
  return sum;
}

}  // namespace tack
