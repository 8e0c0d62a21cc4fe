// Isotropic hyperelasticity in principal stretches s (singular values of F), for several tets side
// by side. Conventions of the derivatives follow Stomakhin et al. 2012 and Smith et al. 2019.
#pragma once

#include "framework/assembly/pack_projection.hpp"
#include "geometry/types.hpp"

namespace tack {

// A density psi(s) [J/m^3] with gradient and Hessian in s.
struct PrincipalDerivatives {
  PackVec3 gradient;
  PackMat3 hessian;
};

// Returns the derivatives in stretches s of a density of logarithmic strains ln s with the gradient
// tau (Kirchhoff's stress) and the Hessian h + c I [Pa]:
//     psi_i = tau_i / s_i,   psi_ik = (h_ik + delta_ik (c - tau_i)) / (s_i s_k).
inline PrincipalDerivatives of_logarithms(const PackVec3& s, const PackVec3& tau, const PackMat3& h,
                                          const Pack& c) {
  PrincipalDerivatives d;
  PackVec3 inverse;
  for (int i = 0; i < 3; ++i) inverse(i) = 1 / s(i);
  for (int i = 0; i < 3; ++i) {
    d.gradient(i) = tau(i) * inverse(i);
    for (int k = 0; k < 3; ++k) d.hessian(i, k) = h(i, k) * inverse(i) * inverse(k);
    d.hessian(i, i) += (c - tau(i)) * inverse(i) * inverse(i);
  }
  return d;
}

// dP/dF in the principal frame F^ = diag(s): a 3x3 matrix on the diagonal entries, and for each
// i != j a 2x2 matrix [same cross; cross same] on the entries (ij, ji). The diagonals of the latter
// are unused.
struct PrincipalHessian {
  PackMat3 diagonal;
  PackMat3 same;
  PackMat3 cross;
};

// Makes symmetric 3x3 matrices positive semi-definite; leaves definite ones alone.
void project_diagonal(PackMat3& a, Projection projection);

inline PrincipalHessian principal_hessian(const PackVec3& s, const PrincipalDerivatives& d,
                                          Projection projection) {
  PrincipalHessian h;
  h.diagonal = d.hessian;
  project_diagonal(h.diagonal, projection);
  for (int i = 0; i < 3; ++i) {
    for (int j = i + 1; j < 3; ++j) {
      // Stretching mode: the divided difference, or its limit where the stretches (nearly) agree.
      const Pack gap = s(i) - s(j), sum = s(i) + s(j);
      const Pack limit = 0.5 * (d.hessian(i, i) + d.hessian(j, j)) - d.hessian(i, j);
      const Pack quotient = (d.gradient(i) - d.gradient(j)) / gap;
      const Pack stretch = projected(select(abs(gap) < 1e-6 * sum, limit, quotient), projection);
      const Pack twist = projected(Pack((d.gradient(i) + d.gradient(j)) / sum), projection);
      h.same(i, j) = h.same(j, i) = 0.5 * (stretch + twist);
      h.cross(i, j) = h.cross(j, i) = 0.5 * (stretch - twist);
    }
  }
  return h;
}

}  // namespace tack
