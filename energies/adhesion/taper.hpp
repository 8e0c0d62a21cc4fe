// Taper of a law without a finite range: the energy times a step that falls from 1 to 0 over the
// last quarter of the range, with two continuous derivatives. The energy at contact, and with it
// the work of adhesion, does not change: the work of the tail beyond the range moves into that
// quarter.
#pragma once

namespace tack {

inline constexpr double tapered_part = 0.25;

template <class T>
T taper(const T& d, double range) {
  if (d < T((1 - tapered_part) * range)) return T(1.0);
  const T s = (T(range) - d) / T(tapered_part * range);
  return s * s * s * (T(10.0) - s * (T(15.0) - T(6.0) * s));
}

}  // namespace tack
