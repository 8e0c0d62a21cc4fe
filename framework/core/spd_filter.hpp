// How a stencil's Hessian is made positive semi-definite before assembly.
#pragma once

namespace tack {

enum class SpdFilter {
  none,      // the exact Hessian
  clamp,     // negative eigenvalues become zero (Teran et al. 2005; the paper, section 5)
  absolute,  // negative eigenvalues become their absolute value (Chen et al. 2024)
  majorize,  // clamp; terms that know one give the Hessian of a quadratic that lies above them
};

// One eigenvalue under the policy.
inline double filtered(double eigenvalue, SpdFilter filter) {
  if (eigenvalue >= 0 || filter == SpdFilter::none) return eigenvalue;
  return filter == SpdFilter::absolute ? -eigenvalue : 0.0;
}

}  // namespace tack
