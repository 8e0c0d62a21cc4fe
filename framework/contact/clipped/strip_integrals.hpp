// Integrals of 1 - rho across a strip (boundary_weight.hpp), of several pairs side by side.
#pragma once

#include "framework/contact/clipped/boundary_weight.hpp"
#include "geometry/pack.hpp"

namespace tack {

// With t = s / R: 1 - rho, and its integrals from 1 to t with the factors 1, x - t, (x - t)^2. They
// are polynomials because the integrals of 1 - rho and t (1 - rho) over the strip are zero.
inline Pack weight_lost(const Pack& t) { return 1 - BoundaryWeight::value_in_strip(t); }
inline Pack weight_lost_0(const Pack& t) {
  const Pack u = 1 - t;
  return t * u * u * u * (1 - 3 * t);
}
inline Pack weight_lost_1(const Pack& t) {
  const Pack u = t * (1 - t) * (1 - t);
  return -0.5 * u * u;
}
inline Pack weight_lost_2(const Pack& t) {
  return t * t * t * (1.0 / 3 + t * (-1 + t * (6.0 / 5 + t * (-2.0 / 3 + t * (1.0 / 7))))) -
         1.0 / 105;
}

}  // namespace tack
