// A sheet's deformation within its plane: F = U diag(s) V^T of a 3x2 matrix F, for several
// triangles side by side. The derivatives of an isotropic density psi(s1, s2) and their projection
// follow Stomakhin et al. 2012 and Smith et al. 2019, as those of solids do
// (energies/solid/principal.hpp); out of the plane, the sheet is a string with the force psi_i /
// s_i per length.
#pragma once

#include <Eigen/Geometry>

#include "framework/assembly/pack_projection.hpp"
#include "geometry/types.hpp"

namespace tack {

using PackVec2 = PackMatrix<2>;
using PackMat2 = PackMatrix<2, 2>;
using PackMat32 = PackMatrix<3, 2>;

struct PlaneStretch {
  PackMat3 u;  // the two directions in the sheet, and its normal
  PackMat2 v;
  PackVec2 s;
};

// By one rotation of the columns of F to orthogonality (one-sided Jacobi).
inline PlaneStretch plane_stretch(const PackMat32& f) {
  const Pack pp = f.col(0).squaredNorm(), qq = f.col(1).squaredNorm(), pq = f.col(0).dot(f.col(1));
  const PackMask turn = pq * pq > 1e-31 * pp * qq;
  const Pack difference = qq - pp, twice = 2 * pq;
  const Pack adjacent = abs(difference) + sqrt(difference * difference + twice * twice);
  const Pack opposite = select(difference < 0, -twice, twice);
  const Pack inverse = 1 / sqrt(adjacent * adjacent + opposite * opposite);
  const Pack c = select(turn, adjacent * inverse, 1), s = select(turn, opposite * inverse, 0);
  PlaneStretch p;
  p.v(0, 0) = p.v(1, 1) = c;
  p.v(0, 1) = s;
  p.v(1, 0) = -s;
  for (int i = 0; i < 2; ++i) {
    const PackVec3 column = f.col(0) * p.v(0, i) + f.col(1) * p.v(1, i);
    p.s(i) = sqrt(column.squaredNorm());
    const Pack scale = 1 / p.s(i);
    for (int k = 0; k < 3; ++k) p.u(k, i) = column(k) * scale;
  }
  p.u.col(2) = PackVec3(p.u.col(0)).cross(PackVec3(p.u.col(1)));
  return p;
}

// The invariants of Green's strain (F^T F - I) / 2: what is small is computed as such.
struct PlaneStrain {
  Pack trace, det;
  Pack xx, yy, xy;
};

inline PlaneStrain plane_strain(const PackMat32& f) {
  PlaneStrain e;
  e.xx = (f.col(0).squaredNorm() - 1) / 2;
  e.yy = (f.col(1).squaredNorm() - 1) / 2;
  e.xy = f.col(0).dot(f.col(1)) / 2;
  e.trace = e.xx + e.yy;
  e.det = e.xx * e.yy - e.xy * e.xy;
  return e;
}

// Derivatives of a density psi(s) [J/m^3].
struct PlaneDerivatives {
  PackVec2 gradient;
  PackMat2 hessian;
};

// Returns the derivatives in stretches s of a density of ln s with the gradient tau and the Hessian
// h [Pa]: psi_i = tau_i / s_i, psi_ik = (h_ik - delta_ik tau_i) / (s_i s_k).
inline PlaneDerivatives of_logarithms(const PackVec2& s, const PackVec2& tau, const PackMat2& h) {
  PlaneDerivatives d;
  for (int i = 0; i < 2; ++i) {
    d.gradient(i) = tau(i) / s(i);
    d.hessian(i, i) = (h(i, i) - tau(i)) / (s(i) * s(i));
  }
  d.hessian(0, 1) = d.hessian(1, 0) = h(0, 1) / s.prod();
  return d;
}

// dP/dF in the frame of U: on the diagonal entries, on the pair (01, 10) the matrix [same cross;
// cross same], and on each entry (2i) one number.
struct PlaneHessian {
  PackMat2 diagonal;
  Pack same, cross;
  PackVec2 out;
};

inline PlaneHessian plane_hessian(const PackVec2& s, const PlaneDerivatives& d,
                                  Projection projection) {
  PlaneHessian h;
  h.diagonal = d.hessian;
  if (projection != Projection::none) {
    const Pack det = h.diagonal(0, 0) * h.diagonal(1, 1) - h.diagonal(0, 1) * h.diagonal(1, 0);
    if (any(~((h.diagonal(0, 0) > 0) & (det > 0)))) project_psd<2>(h.diagonal, projection);
  }
  // The divided difference, or its limit where the stretches (nearly) agree.
  const Pack gap = s(0) - s(1), sum = s(0) + s(1);
  const Pack limit = 0.5 * (d.hessian(0, 0) + d.hessian(1, 1)) - d.hessian(0, 1);
  const Pack quotient = (d.gradient(0) - d.gradient(1)) / gap;
  const Pack strain = projected(select(abs(gap) < 1e-6 * sum, limit, quotient), projection);
  const Pack spin = projected(Pack((d.gradient(0) + d.gradient(1)) / sum), projection);
  h.same = 0.5 * (strain + spin);
  h.cross = 0.5 * (strain - spin);
  for (int i = 0; i < 2; ++i) h.out(i) = projected(Pack(d.gradient(i) / s(i)), projection);
  return h;
}

}  // namespace tack
