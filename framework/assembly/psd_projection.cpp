#include "framework/assembly/psd_projection.hpp"

#include <array>
#include <cmath>

#include "framework/assembly/symmetric_eigen.hpp"

namespace tack {
namespace {

// Rows: an orthonormal basis of the complement of (1, ..., 1) in R^K (Helmert): row r is
// scale[r] (1, ..., 1, -(r+1), 0, ..., 0).
template <int K>
const std::array<double, K - 1> helmert_scale = [] {
  std::array<double, K - 1> scale;
  for (int r = 0; r < K - 1; ++r) scale[r] = 1.0 / std::sqrt((r + 1.0) * (r + 2.0));
  return scale;
}();

// y <- H y for the K numbers at y, y + stride, ...; the last of them is dropped (left as it is).
template <int K>
void reduce(double* y, int stride) {
  double sum = 0;
  for (int r = 0; r < K - 1; ++r) {
    sum += y[r * stride];
    y[r * stride] = helmert_scale<K>[r] * (sum - (r + 1) * y[(r + 1) * stride]);
  }
}

// y <- H^T y, the inverse: K - 1 numbers become K.
template <int K>
void expand(double* y, int stride) {
  double sum = 0;  // of the terms of later rows
  for (int r = K - 2; r >= 0; --r) {
    const double summand = helmert_scale<K>[r] * y[r * stride];
    y[(r + 1) * stride] = sum - (r + 1) * summand;
    sum += summand;
  }
  y[0] = sum;
}

// Returns true if the Cholesky factorisation of the lower triangle succeeds.
template <int N>
bool positive_definite(Eigen::Matrix<double, N, N> a) {
  for (int k = 0; k < N; ++k) {
    if (!(a(k, k) > 0)) return false;
    const double inverse = 1 / a(k, k);
    for (int j = k + 1; j < N; ++j) {
      const double factor = a(j, k) * inverse;
      for (int i = j; i < N; ++i) a(i, j) -= factor * a(i, k);
    }
  }
  return true;
}

}  // namespace

template <int N>
void project_psd(Eigen::Matrix<double, N, N>& hessian, Projection projection) {
  if (projection == Projection::none || positive_definite<N>(hessian)) return;
  const SymmetricEigen<N> eigen(hessian);
  hessian.setZero();  // sum of projected lambda v v^T
  for (int i = 0; i < N; ++i) {
    const double lambda = projected(eigen.values()(i), projection);
    if (lambda == 0) continue;
    const auto v = eigen.vectors().col(i);
    for (int c = 0; c < N; ++c)
      for (int r = 0; r < N; ++r) hessian(r, c) += lambda * (v(r) * v(c));
  }
}

template <int K>
void project_stencil_psd(Eigen::Matrix<double, 3 * K, 3 * K>& hessian, Projection projection) {
  if (projection == Projection::none) return;
  constexpr int n = 3 * (K - 1), full = 3 * K;
  Eigen::Matrix<double, full, full> work = hessian;
  for (int c = 0; c < full; ++c)
    for (int d = 0; d < 3; ++d) reduce<K>(&work(d, c), 3);
  for (int r = 0; r < n; ++r)
    for (int d = 0; d < 3; ++d) reduce<K>(&work(r, d), 3 * full);
  const Eigen::Matrix<double, n, n> before = work.template topLeftCorner<n, n>();
  Eigen::Matrix<double, n, n> after = before;
  project_psd<n>(after, projection);
  if (after == before) return;
  work.template topLeftCorner<n, n>() = after;
  for (int r = 0; r < n; ++r)
    for (int d = 0; d < 3; ++d) expand<K>(&work(r, d), 3 * full);
  for (int c = 0; c < full; ++c)
    for (int d = 0; d < 3; ++d) expand<K>(&work(d, c), 3);
  hessian = work;
}

void project_scalar_psd(Eigen::Matrix<double, 15, 15>& hessian, Projection projection) {
  if (projection == Projection::none) return;
  // Columns: an orthonormal basis of the displacements that change the energy.
  using Basis = Eigen::Matrix<double, 15, 8>;
  static const Basis basis = [] {
    Basis b = Basis::Zero();
    for (int d = 0; d < 3; ++d)
      for (int r = 0; r < 2; ++r) {
        for (int i = 0; i <= r; ++i) b(3 * i + d, 3 * r + d) = helmert_scale<3>[r];
        b(3 * (r + 1) + d, 3 * r + d) = -(r + 1) * helmert_scale<3>[r];
      }
    b(9, 6) = b(12, 7) = 1;
    return b;
  }();
  const Eigen::Matrix<double, 8, 8> before = basis.transpose() * hessian * basis;
  Eigen::Matrix<double, 8, 8> after = before;
  project_psd<8>(after, projection);
  if (after != before) hessian = basis * after * basis.transpose();
}

template void project_psd<2>(Eigen::Matrix<double, 2, 2>&, Projection);
template void project_psd<3>(Mat3&, Projection);
template void project_psd<6>(Eigen::Matrix<double, 6, 6>&, Projection);
template void project_psd<8>(Eigen::Matrix<double, 8, 8>&, Projection);
template void project_psd<9>(Mat9&, Projection);
template void project_stencil_psd<2>(Eigen::Matrix<double, 6, 6>&, Projection);
template void project_stencil_psd<3>(Mat9&, Projection);
template void project_stencil_psd<4>(Mat12&, Projection);
template void project_stencil_psd<5>(Eigen::Matrix<double, 15, 15>&, Projection);
template void project_stencil_psd<6>(Eigen::Matrix<double, 18, 18>&, Projection);
template void project_stencil_psd<7>(Eigen::Matrix<double, 21, 21>&, Projection);
template void project_stencil_psd<8>(Eigen::Matrix<double, 24, 24>&, Projection);
template void project_stencil_psd<9>(Eigen::Matrix<double, 27, 27>&, Projection);
template void project_stencil_psd<10>(Eigen::Matrix<double, 30, 30>&, Projection);

}  // namespace tack
