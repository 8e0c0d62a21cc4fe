// How a stencil's Hessian is made positive semi-definite before assembly.
#pragma once

namespace tack {

enum class Projection {
  none,      // the exact Hessian
  clamp,     // negative eigenvalues become zero (Teran et al. 2005; the paper, section 5)
  absolute,  // negative eigenvalues become their absolute value (Chen et al. 2024)
  majorize,  // clamp; terms that know one give the Hessian of a quadratic that lies above them
};

// One eigenvalue under the policy.
inline double projected(double eigenvalue, Projection projection) {
  if (eigenvalue >= 0 || projection == Projection::none) return eigenvalue;
  return projection == Projection::absolute ? -eigenvalue : 0.0;
}

}  // namespace tack
