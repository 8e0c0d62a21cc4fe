// Argument checks of shapes. They throw InputError with the shape, the argument and its allowed
// values.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "geometry/errors.hpp"

namespace tack {

inline void require_positive(const char* shape, const char* what, double value) {
  if (value > 0 && std::isfinite(value)) return;
  throw InputError(fmt::format("{}: {} is {}, but has to be positive", shape, what, value));
}

inline void require_at_least(const char* shape, const char* what, int value, int least) {
  if (value >= least) return;
  throw InputError(
      fmt::format("{}: {} is {}, but has to be at least {}", shape, what, value, least));
}

inline void require_even(const char* shape, const char* what, int value) {
  if (value % 2 == 0) return;
  throw InputError(
      fmt::format("{}: {} is {}, but has to be even (the mesh is symmetric about its "
                  "centre): use {} or {}",
                  shape, what, value, value - 1, value + 1));
}

// Limits the number of vertices: coordinates are indexed by int, and more would not fit in memory.
inline void require_count(const char* shape, double vertices) {
  constexpr double most = 1e7;
  if (vertices <= most) return;
  throw InputError(fmt::format("{}: {} vertices are too many, at most {}: use fewer cells", shape,
                               vertices, most));
}

}  // namespace tack
