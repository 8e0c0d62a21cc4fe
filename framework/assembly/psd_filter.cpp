#include "framework/assembly/psd_filter.hpp"

#include <cmath>

#include "framework/assembly/symmetric_eigen.hpp"

namespace tack {
namespace {

// Rows: an orthonormal basis of the complement of (1, ..., 1) in R^K (Helmert).
template <int K>
Eigen::Matrix<double, K - 1, K> helmert() {
  Eigen::Matrix<double, K - 1, K> basis = Eigen::Matrix<double, K - 1, K>::Zero();
  for (int r = 0; r < K - 1; ++r) {
    const double scale = 1.0 / std::sqrt((r + 1.0) * (r + 2.0));
    basis.row(r).head(r + 1).setConstant(scale);
    basis(r, r + 1) = -(r + 1.0) * scale;
  }
  return basis;
}

template <int K>
using Reduction = Eigen::Matrix<double, 3 * (K - 1), 3 * K>;

template <int K>
Reduction<K> reduction() {
  const auto basis = helmert<K>();
  Reduction<K> r;
  for (int i = 0; i < K - 1; ++i)
    for (int j = 0; j < K; ++j) r.template block<3, 3>(3 * i, 3 * j) = basis(i, j) * Mat3::Identity();
  return r;
}

template <int K>
const Reduction<K> reduction_of = reduction<K>();

// Whether a Cholesky factorisation of the lower triangle runs through.
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
void project_psd(Eigen::Matrix<double, N, N>& hessian, SpdFilter filter) {
  if (filter == SpdFilter::none || positive_definite<N>(hessian)) return;
  const SymmetricEigen<N> eigen(hessian);
  hessian.setZero();  // sum of filtered lambda v v^T
  for (int i = 0; i < N; ++i) {
    const double lambda = filtered(eigen.values()(i), filter);
    if (lambda == 0) continue;
    const auto v = eigen.vectors().col(i);
    for (int c = 0; c < N; ++c)
      for (int r = 0; r < N; ++r) hessian(r, c) += lambda * (v(r) * v(c));
  }
}

template <int K>
void project_stencil_psd(Eigen::Matrix<double, 3 * K, 3 * K>& hessian, SpdFilter filter) {
  if (filter == SpdFilter::none) return;
  constexpr int n = 3 * (K - 1);
  const Reduction<K>& r = reduction_of<K>;
  const Eigen::Matrix<double, n, n> before = r * hessian * r.transpose();
  Eigen::Matrix<double, n, n> after = before;
  project_psd<n>(after, filter);
  if (after != before) hessian.noalias() = r.transpose() * after * r;
}

template void project_psd<2>(Eigen::Matrix<double, 2, 2>&, SpdFilter);
template void project_psd<3>(Mat3&, SpdFilter);
template void project_psd<5>(Eigen::Matrix<double, 5, 5>&, SpdFilter);
template void project_psd<6>(Eigen::Matrix<double, 6, 6>&, SpdFilter);
template void project_psd<9>(Mat9&, SpdFilter);
template void project_stencil_psd<2>(Eigen::Matrix<double, 6, 6>&, SpdFilter);
template void project_stencil_psd<3>(Mat9&, SpdFilter);
template void project_stencil_psd<4>(Mat12&, SpdFilter);

}  // namespace tack
