// Isotropic hyperelasticity in principal stretches s (singular values of F).
// Conventions of the derivatives follow Stomakhin et al. 2012 and Smith et al. 2019.
#pragma once

#include "framework/core/spd_filter.hpp"
#include "geometry/types.hpp"

namespace tack {

// A density psi(s) [J/m^3] with gradient and Hessian in s.
struct PrincipalDerivatives {
  Vec3 gradient;
  Mat3 hessian;
};

// dP/dF in the principal frame F^ = diag(s): a 3x3 matrix on the diagonal entries, and for each
// i != j a 2x2 matrix [same cross; cross same] on the entries (ij, ji).
struct PrincipalHessian {
  Mat3 diagonal;
  Mat3 same;
  Mat3 cross;
};

// Makes a symmetric 3x3 matrix positive semi-definite; leaves a definite one alone.
void filter_diagonal(Mat3& a, SpdFilter filter);

inline PrincipalHessian principal_hessian(const Vec3& s, const PrincipalDerivatives& d,
                                          SpdFilter filter) {
  PrincipalHessian h;
  h.diagonal = d.hessian;
  filter_diagonal(h.diagonal, filter);
  h.same.setZero();
  h.cross.setZero();
  for (int i = 0; i < 3; ++i) {
    for (int j = i + 1; j < 3; ++j) {
      // Stretching mode: the divided difference, or its limit where the stretches (nearly) agree.
      const double gap = s(i) - s(j);
      const bool close = std::abs(gap) < 1e-6 * (s(i) + s(j));
      double stretch = close ? 0.5 * (d.hessian(i, i) + d.hessian(j, j)) - d.hessian(i, j)
                             : (d.gradient(i) - d.gradient(j)) / gap;
      double twist = (d.gradient(i) + d.gradient(j)) / (s(i) + s(j));
      stretch = filtered(stretch, filter);
      twist = filtered(twist, filter);
      h.same(i, j) = h.same(j, i) = 0.5 * (stretch + twist);
      h.cross(i, j) = h.cross(j, i) = 0.5 * (stretch - twist);
    }
  }
  return h;
}

}  // namespace tack
