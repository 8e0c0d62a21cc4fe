// Singular value decomposition F = U diag(s) V^T of a 3x3 matrix with det F > 0 by one-sided Jacobi
// rotations: columns of F V are made orthogonal. High relative accuracy also for small singular
// values; U and V are rotations.
#pragma once

#include <cmath>

#include "geometry/types.hpp"

namespace tack {

struct Svd3 {
  Mat3 u, v;
  Vec3 s;
};

namespace detail {

// Rotates columns p and q of a (and v) to orthogonality. Returns false if they were orthogonal.
inline bool jacobi_rotate(Mat3& a, Mat3& v, int p, int q) {
  const double app = a.col(p).squaredNorm(), aqq = a.col(q).squaredNorm();
  const double apq = a.col(p).dot(a.col(q));
  if (apq * apq <= 1e-31 * app * aqq) return false;
  const double tau = (aqq - app) / (2 * apq);
  const double t = (tau >= 0 ? 1 : -1) / (std::abs(tau) + std::sqrt(1 + tau * tau));
  const double c = 1 / std::sqrt(1 + t * t), s = t * c;
  for (Mat3* m : {&a, &v}) {
    const Vec3 old = m->col(p);
    m->col(p) = c * old - s * m->col(q);
    m->col(q) = s * old + c * m->col(q);
  }
  return true;
}

}  // namespace detail

inline Svd3 svd3(const Mat3& f) {
  Svd3 r;
  r.u = f;
  r.v.setIdentity();
  for (int sweep = 0; sweep < 12; ++sweep) {
    bool rotated = detail::jacobi_rotate(r.u, r.v, 0, 1);
    rotated |= detail::jacobi_rotate(r.u, r.v, 0, 2);
    rotated |= detail::jacobi_rotate(r.u, r.v, 1, 2);
    if (!rotated) break;
  }
  for (int i = 0; i < 3; ++i) {
    r.s(i) = r.u.col(i).norm();
    r.u.col(i) /= r.s(i);
  }
  return r;
}

}  // namespace tack
