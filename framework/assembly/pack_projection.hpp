// Projections of several symmetric matrices side by side onto the positive semi-definite cone.
#pragma once

#include "framework/core/projection.hpp"
#include "geometry/pack.hpp"

namespace tack {

/// Returns the projected eigenvalue of each matrix.
inline Pack projected(const Pack& eigenvalue, Projection projection) {
  if (projection == Projection::none) return eigenvalue;
  return select(eigenvalue < 0, projection == Projection::absolute ? -eigenvalue : Pack(0),
                eigenvalue);
}

namespace detail {

/// A <- J^T A J, V <- V J with the rotation J that zeroes A_pq, where A_pq is not negligible.
/// Returns false if it is negligible in all matrices.
template <int N>
[[gnu::always_inline]] inline bool rotate_symmetric(PackMatrix<N, N>& a, PackMatrix<N, N>& v,
                                                    const Pack& negligible, int p, int q) {
  const PackMask turn = ~(a(p, q) * a(p, q) <= negligible);  // also where they are not numbers
  if (!any(turn)) return false;
  // tan of the angle: the smaller root of t^2 + (A_qq - A_pp) / A_pq t - 1 = 0
  const Pack difference = a(q, q) - a(p, p), twice = 2 * a(p, q);
  const Pack adjacent = abs(difference) + sqrt(difference * difference + twice * twice);
  const Pack opposite = select(difference < 0, -twice, twice);
  const Pack inverse = 1 / sqrt(adjacent * adjacent + opposite * opposite);
  const Pack c = select(turn, adjacent * inverse, 1), s = select(turn, opposite * inverse, 0);
  const Pack pp = a(p, p), qq = a(q, q), pq = a(p, q), cross = 2 * c * s * pq;
  a(p, p) = c * c * pp - cross + s * s * qq;
  a(q, q) = s * s * pp + cross + c * c * qq;
  a(p, q) = a(q, p) = select(turn, 0, pq);
  for (int k = 0; k < N; ++k) {
    if (k != p && k != q) {
      const Pack old = a(k, p);
      a(k, p) = a(p, k) = c * old - s * a(k, q);
      a(k, q) = a(q, k) = s * old + c * a(k, q);
    }
    const Pack old = v(k, p);
    v(k, p) = c * old - s * v(k, q);
    v(k, q) = s * old + c * v(k, q);
  }
  return true;
}

}  // namespace detail

/// Cyclic Jacobi rotations until off-diagonal entries are below the round-off of each matrix. The
/// result of a matrix does not depend on the others. Matrices that are not finite stay so; entries
/// whose squares overflow count as not finite.
template <int N>
void project_psd(PackMatrix<N, N>& a, Projection projection) {
  if (projection == Projection::none) return;
  PackMatrix<N, N> v;
  for (int i = 0; i < N * N; ++i) v(i) = i % (N + 1) == 0 ? 1.0 : 0.0;
  const Pack size = a.squaredNorm();
  // The difference is not a number if size is infinite
  const Pack negligible = 1e-34 * size + (size - size);
  bool rotated = true;
  for (int sweep = 0; rotated && sweep < 12; ++sweep) {
    rotated = false;
    for (int p = 0; p < N; ++p)
      for (int q = p + 1; q < N; ++q)
        rotated |= detail::rotate_symmetric<N>(a, v, negligible, p, q);
  }
  PackMatrix<N, N> scaled;
  for (int j = 0; j < N; ++j) {
    const Pack lambda = projected(a(j, j), projection);
    for (int i = 0; i < N; ++i) scaled(i, j) = v(i, j) * lambda;
  }
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j <= i; ++j) {
      Pack sum = scaled(i, 0) * v(j, 0);
      for (int k = 1; k < N; ++k) sum += scaled(i, k) * v(j, k);
      a(i, j) = a(j, i) = sum;
    }
  }
}

}  // namespace tack
