// Split of an isotropic energy, psi(F) = psi_s(F) + U(J), for elements that use a mean volume over
// several points: U(mean J) replaces U(J), so that volume does not lock. A splittable material has
//   auto split() const;   a MaterialSplit
// of materials (solid_term.hpp, solid_residuals.hpp) and a law of volume. The part of U that is no
// sum of squares, or that keeps the volume from vanishing, stays in psi_s.
#pragma once

#include <cmath>

#include "geometry/pack.hpp"

namespace tack {

// Fraction of psi_s that composite tets assign to their parts (composite_term.hpp): below 0.02
// steps stall, beyond 0.1 bending stiffens.
inline constexpr double weight_of_parts = 0.05;

/// psi_s; its substitute in the parts of tets, which has equal stiffness at rest and is infinite at
/// J = 0, so that parts do not invert; and U.
template <class Shape, class Part, class Volume>
struct MaterialSplit {
  Shape shape;
  Part part;
  Volume volume;
};

/// U and its derivatives [Pa].
template <class T>
struct VolumeSample {
  T energy, pressure, bulk;
};

/// U = modulus/2 (ln J)^2, modulus >= 0.
struct LogVolume {
  double modulus;  // Pa

  /// growth: J - 1.
  template <class T>
  VolumeSample<T> at(const T& growth) const {
    using std::log1p;
    const T log_j = log1p(growth), inverse = 1 / (1 + growth);
    return {modulus / 2 * log_j * log_j, modulus * log_j * inverse,
            modulus * (1 - log_j) * inverse * inverse};
  }
  /// g with U = g^2 / 2, and its slope.
  double root(double j) const { return std::sqrt(modulus) * std::log(j); }
  double root_slope(double j) const { return std::sqrt(modulus) / j; }
};

/// U = modulus/2 (J - 1)^2, modulus >= 0.
struct QuadraticVolume {
  double modulus;  // Pa

  template <class T>
  VolumeSample<T> at(const T& growth) const {
    return {modulus / 2 * growth * growth, modulus * growth, modulus};
  }
  double root(double j) const { return std::sqrt(modulus) * (j - 1); }
  double root_slope(double) const { return std::sqrt(modulus); }
};

/// det F - 1, without the terms of first order that cancel on paper where F is close to a rotation.
inline Pack volume_growth(const PackMat3& f) {
  PackMat3 h = f;
  for (int i = 0; i < 3; ++i) h(i, i) -= 1;
  const Pack minors = h(0, 0) * h(1, 1) - h(0, 1) * h(1, 0) + h(1, 1) * h(2, 2) -
                      h(1, 2) * h(2, 1) + h(2, 2) * h(0, 0) - h(2, 0) * h(0, 2);
  return h.trace() + minors + h.determinant();
}

/// A material that offers the split.
template <class Material>
concept SplitMaterial = requires(const Material& material) {
  material.split();
};

}  // namespace tack
