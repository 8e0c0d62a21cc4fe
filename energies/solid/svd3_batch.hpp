// Singular value decompositions F = U diag(s) V^T of several 3x3 matrices at once (det F > 0), by
// one-sided Jacobi rotations like svd3.hpp. Entries of the matrices lie side by side, one lane per
// matrix, and lanes never branch, so that the compiler vectorises every loop over lanes. A lane's
// result does not depend on its neighbours.
#pragma once

#include <cmath>

#include "energies/solid/svd3.hpp"

namespace tack {

template <int lanes>
class Svd3Batch {
 public:
  void set(int lane, const Mat3& f) {
    for (int k = 0; k < 9; ++k) u_[k][lane] = f.data()[k];
  }

  void decompose() {
    for (int k = 0; k < 9; ++k)
      for (int l = 0; l < lanes; ++l) v_[k][l] = k % 4 == 0 ? 1 : 0;
    for (int sweep = 0; sweep < 12; ++sweep) {
      bool rotated = rotate(0, 1);
      rotated |= rotate(0, 2);
      rotated |= rotate(1, 2);
      if (!rotated) break;
    }
    for (int c = 0; c < 3; ++c) {
      for (int l = 0; l < lanes; ++l) {
        const double x = u_[3 * c][l], y = u_[3 * c + 1][l], z = u_[3 * c + 2][l];
        s_[c][l] = std::sqrt(x * x + y * y + z * z);
      }
      for (int r = 0; r < 3; ++r)
        for (int l = 0; l < lanes; ++l) u_[3 * c + r][l] /= s_[c][l];
    }
  }

  Svd3 get(int lane) const {
    Svd3 out;
    for (int k = 0; k < 9; ++k) {
      out.u.data()[k] = u_[k][lane];
      out.v.data()[k] = v_[k][lane];
    }
    for (int c = 0; c < 3; ++c) out.s(c) = s_[c][lane];
    return out;
  }

 private:
  using Lanes = double[lanes];

  // Makes columns p and q orthogonal. False if they were, in every lane.
  bool rotate(int p, int q) {
    alignas(64) Lanes c, s;
    int turned = 0;
    for (int l = 0; l < lanes; ++l) {
      double pp = 0, qq = 0, pq = 0;
      for (int r = 0; r < 3; ++r) {
        const double a = u_[3 * p + r][l], b = u_[3 * q + r][l];
        pp += a * a;
        qq += b * b;
        pq += a * b;
      }
      const bool turn = pq * pq > 1e-31 * pp * qq;
      const double tau = (qq - pp) / (2 * (turn ? pq : 1));
      const double t = std::copysign(1.0, tau) / (std::abs(tau) + std::sqrt(1 + tau * tau));
      const double cosine = 1 / std::sqrt(1 + t * t);
      c[l] = turn ? cosine : 1;
      s[l] = turn ? t * cosine : 0;
      turned += turn;
    }
    for (Lanes* m : {u_, v_}) {
      for (int r = 0; r < 3; ++r) {
        Lanes &a = m[3 * p + r], &b = m[3 * q + r];
        for (int l = 0; l < lanes; ++l) {
          const double old = a[l];
          a[l] = c[l] * old - s[l] * b[l];
          b[l] = s[l] * old + c[l] * b[l];
        }
      }
    }
    return turned > 0;
  }

  alignas(64) Lanes u_[9];  // column major
  alignas(64) Lanes v_[9];
  alignas(64) Lanes s_[3];
};

}  // namespace tack
