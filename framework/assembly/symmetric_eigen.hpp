// Eigenvalues and eigenvectors of a small symmetric matrix of fixed size: Householder reduction to
// tridiagonal form, then implicit QL (Bowdler, Martin, Reinsch, Wilkinson 1968; EISPACK's tred2 and
// tql2). Sums are taken in index order, so that the result has the same bits wherever the matrix
// lies in memory; Eigen's SelfAdjointEigenSolver sums in an order that depends on the address.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace tack {

/// Eigenvalues and eigenvectors of a symmetric matrix of size N.
template <int N>
class SymmetricEigen {
 public:
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;

  explicit SymmetricEigen(const Matrix& symmetric) : v_(symmetric) {
    tridiagonalize();
    accumulate();
    diagonalize();
  }

  const Vector& values() const { return d_; }   // in no order
  const Matrix& vectors() const { return v_; }  // columns, orthonormal

 private:
  // Reflections i = N-1 ... 1, each scaled against underflow; d_ holds the reflection's vector
  // while it acts, e_ the subdiagonal. Column i of v_ keeps the vector, d_(i) half its squared
  // norm.
  void tridiagonalize() {
    for (int j = 0; j < N; ++j) d_(j) = v_(N - 1, j);
    for (int i = N - 1; i > 0; --i) {
      double scale = 0, h = 0;
      for (int k = 0; k < i; ++k) scale += std::abs(d_(k));
      if (scale == 0) {
        e_(i) = d_(i - 1);
        for (int j = 0; j < i; ++j) {
          d_(j) = v_(i - 1, j);
          v_(i, j) = v_(j, i) = 0;
        }
      } else {
        for (int k = 0; k < i; ++k) {
          d_(k) /= scale;
          h += d_(k) * d_(k);
        }
        const double f = d_(i - 1), g = f > 0 ? -std::sqrt(h) : std::sqrt(h);
        e_(i) = scale * g;
        h -= f * g;
        d_(i - 1) = f - g;
        reflect(i, h);
      }
      d_(i) = h;
    }
  }

  // A <- A - u w^T - w u^T on the leading i x i block, of which v_ holds the lower triangle.
  void reflect(int i, double h) {
    for (int j = 0; j < i; ++j) e_(j) = 0;
    for (int j = 0; j < i; ++j) {
      const double f = d_(j);
      v_(j, i) = f;
      double g = e_(j) + v_(j, j) * f;
      for (int k = j + 1; k < i; ++k) {
        g += v_(k, j) * d_(k);
        e_(k) += v_(k, j) * f;
      }
      e_(j) = g;
    }
    double f = 0;
    for (int j = 0; j < i; ++j) {
      e_(j) /= h;
      f += e_(j) * d_(j);
    }
    const double shift = f / (h + h);
    for (int j = 0; j < i; ++j) e_(j) -= shift * d_(j);
    for (int j = 0; j < i; ++j) {
      for (int k = j; k < i; ++k) v_(k, j) -= d_(j) * e_(k) + e_(j) * d_(k);
      d_(j) = v_(i - 1, j);
      v_(i, j) = 0;
    }
  }

  // The product of the reflections, into v_.
  void accumulate() {
    for (int i = 0; i < N - 1; ++i) {
      v_(N - 1, i) = v_(i, i);
      v_(i, i) = 1;
      const double h = d_(i + 1);
      if (h != 0) {
        for (int k = 0; k <= i; ++k) d_(k) = v_(k, i + 1) / h;
        for (int j = 0; j <= i; ++j) {
          double g = 0;
          for (int k = 0; k <= i; ++k) g += v_(k, i + 1) * v_(k, j);
          for (int k = 0; k <= i; ++k) v_(k, j) -= g * d_(k);
        }
      }
      for (int k = 0; k <= i; ++k) v_(k, i + 1) = 0;
    }
    for (int j = 0; j < N; ++j) {
      d_(j) = v_(N - 1, j);
      v_(N - 1, j) = 0;
    }
    v_(N - 1, N - 1) = 1;
  }

  // QL with Wilkinson-like shifts; a handful of sweeps per eigenvalue, 60 when round-off never
  // settles.
  void diagonalize() {
    constexpr double epsilon = 0x1p-52;
    for (int i = 1; i < N; ++i) e_(i - 1) = e_(i);
    e_(N - 1) = 0;
    double shift = 0, size = 0;
    for (int l = 0; l < N; ++l) {
      size = std::max(size, std::abs(d_(l)) + std::abs(e_(l)));
      int m = l;
      while (m < N - 1 && std::abs(e_(m)) > epsilon * size) ++m;
      for (int sweep = 0; m > l && sweep < 60; ++sweep) {
        double p = (d_(l + 1) - d_(l)) / (2 * e_(l));
        const double r = p < 0 ? -std::sqrt(p * p + 1) : std::sqrt(p * p + 1);
        const double before = d_(l);
        d_(l) = e_(l) / (p + r);
        d_(l + 1) = e_(l) * (p + r);
        const double next = d_(l + 1), moved = before - d_(l), e_next = e_(l + 1);
        for (int i = l + 2; i < N; ++i) d_(i) -= moved;
        shift += moved;
        p = d_(m);
        double c = 1, c2 = 1, c3 = 1, s = 0, s2 = 0;
        for (int i = m - 1; i >= l; --i) {
          c3 = c2, c2 = c, s2 = s;
          const double g = c * e_(i), h = c * p, length = std::sqrt(p * p + e_(i) * e_(i));
          e_(i + 1) = s * length;
          s = e_(i) / length;
          c = p / length;
          p = c * d_(i) - s * g;
          d_(i + 1) = h + s * (c * g + s * d_(i));
          for (int k = 0; k < N; ++k) {
            const double a = v_(k, i), b = v_(k, i + 1);
            v_(k, i + 1) = s * a + c * b;
            v_(k, i) = c * a - s * b;
          }
        }
        p = -s * s2 * c3 * e_next * e_(l) / next;
        e_(l) = s * p;
        d_(l) = c * p;
        if (std::abs(e_(l)) <= epsilon * size) break;
      }
      d_(l) += shift;
      e_(l) = 0;
    }
  }

  Matrix v_;
  Vector d_, e_;
};

}  // namespace tack
