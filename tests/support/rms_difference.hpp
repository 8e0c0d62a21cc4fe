// Root mean square distance of two configurations (3n).
#pragma once

#include <cmath>

#include "geometry/types.hpp"

namespace tack {

inline double rms_difference(const VecX& a, const VecX& b) {
  return (a - b).norm() / std::sqrt(static_cast<double>(a.size()) / 3);
}

}  // namespace tack
