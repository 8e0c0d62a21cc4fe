#include "framework/assembly/psd_filter.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

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

}  // namespace

template <int N>
void project_psd(Eigen::Matrix<double, N, N>& hessian, SpdFilter filter) {
  if (filter == SpdFilter::none) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen(hessian);
  auto lambda = eigen.eigenvalues();
  if (lambda(0) >= 0) return;
  for (int i = 0; i < N; ++i) lambda(i) = filtered(lambda(i), filter);
  hessian.noalias() = eigen.eigenvectors() * lambda.asDiagonal() * eigen.eigenvectors().transpose();
}

template <int K>
void project_stencil_psd(Eigen::Matrix<double, 3 * K, 3 * K>& hessian, SpdFilter filter) {
  if (filter == SpdFilter::none) return;
  constexpr int n = 3 * (K - 1);
  const Reduction<K>& r = reduction_of<K>;
  Eigen::Matrix<double, n, n> reduced = r * hessian * r.transpose();
  if (Eigen::LLT<Eigen::Matrix<double, n, n>>(reduced).info() == Eigen::Success) return;
  project_psd<n>(reduced, filter);
  hessian.noalias() = r.transpose() * reduced * r;
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
