// Projection of the Hessian of a stencil to a positive semi-definite matrix, before assembly.
#pragma once

namespace tack {

/// Projection of the eigenvalues of a stencil's Hessian.
enum class Projection {
  none,      // the exact Hessian
  clamp,     // negative eigenvalues become zero (Teran et al. 2005; the paper, section 5)
  absolute,  // negative eigenvalues become their absolute value (Chen et al. 2024)
  majorize,  // Hessian of a quadratic upper bound, for terms that know one; else clamp
};

/// Returns the projected eigenvalue.
inline double projected(double eigenvalue, Projection projection) {
  if (eigenvalue >= 0 || projection == Projection::none) return eigenvalue;
  return projection == Projection::absolute ? -eigenvalue : 0.0;
}

}  // namespace tack
