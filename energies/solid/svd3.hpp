// Singular value decomposition F = U diag(s) V^T of a 3x3 matrix with det F > 0 by one-sided Jacobi
// rotations: columns of F V are made orthogonal. High relative accuracy also for small singular
// values; U and V are rotations. T: double, or Pack for several matrices at once, each of whose
// results does not depend on the others.
#pragma once

#include <cmath>

#include "geometry/pack.hpp"

namespace tack {

template <class T>
struct Svd3 {
  Eigen::Matrix<T, 3, 3> u, v;
  Eigen::Matrix<T, 3, 1> s;
};

namespace detail {

// Rotates columns p and q of a (and v) to orthogonality. Returns false if all were orthogonal.
template <int p, int q, class T>
bool jacobi_rotate(Eigen::Matrix<T, 3, 3>& a, Eigen::Matrix<T, 3, 3>& v) {
  using std::abs, std::sqrt;
  const T pp = a.col(p).squaredNorm(), qq = a.col(q).squaredNorm(), pq = a.col(p).dot(a.col(q));
  const auto turn = pq * pq > T(1e-31) * pp * qq;
  if (!any(turn)) return false;
  // tan of the angle: the smaller root of t^2 + (qq - pp) / pq t - 1 = 0
  const T difference = qq - pp, twice = T(2) * pq;
  const T adjacent = abs(difference) + sqrt(difference * difference + twice * twice);
  const T opposite = select(difference < T(0), -twice, twice);
  const T inverse = T(1) / sqrt(adjacent * adjacent + opposite * opposite);
  const T c = select(turn, adjacent * inverse, T(1)), s = select(turn, opposite * inverse, T(0));
  for (auto* m : {&a, &v}) {
    for (int r = 0; r < 3; ++r) {
      const T old = (*m)(r, p);
      (*m)(r, p) = c * old - s * (*m)(r, q);
      (*m)(r, q) = s * old + c * (*m)(r, q);
    }
  }
  return true;
}

}  // namespace detail

template <class T>
Svd3<T> svd3(const Eigen::Matrix<T, 3, 3>& f) {
  using std::sqrt;
  Svd3<T> r;
  r.u = f;
  for (int i = 0; i < 9; ++i) r.v(i) = T(i % 4 == 0);
  for (int sweep = 0; sweep < 12; ++sweep) {
    bool rotated = detail::jacobi_rotate<0, 1>(r.u, r.v);
    rotated |= detail::jacobi_rotate<0, 2>(r.u, r.v);
    rotated |= detail::jacobi_rotate<1, 2>(r.u, r.v);
    if (!rotated) break;
  }
  for (int i = 0; i < 3; ++i) {
    r.s(i) = sqrt(T(r.u.col(i).squaredNorm()));
    const T inverse = T(1) / r.s(i);
    for (int k = 0; k < 3; ++k) r.u(k, i) *= inverse;
  }
  return r;
}

}  // namespace tack
