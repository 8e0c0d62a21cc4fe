#include "framework/assembly/mixed_projection.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "framework/core/term.hpp"

namespace tack {
namespace {

template <class Matrix>
void project(int arity, int scalars, double* slots, Projection projection) {
  const int positions = arity - scalars, relative = std::max(positions - 1, 0);
  // Columns: an orthonormal basis of the displacements that change the energy (Helmert's basis for the positions).
  Matrix basis = Matrix::Zero(3 * arity, 3 * relative + scalars);
  for (int r = 0; r < relative; ++r) {
    const double scale = 1 / std::sqrt((r + 1.0) * (r + 2.0));
    for (int d = 0; d < 3; ++d) {
      for (int i = 0; i <= r; ++i) basis(3 * i + d, 3 * r + d) = scale;
      basis(3 * (r + 1) + d, 3 * r + d) = -(r + 1) * scale;
    }
  }
  for (int n = 0; n < scalars; ++n) basis(3 * (positions + n), 3 * relative + n) = 1;
  if (basis.cols() == 0) return;
  Matrix hessian(3 * arity, 3 * arity);
  const double* in = slots;
  for (int i = 0; i < arity; ++i)
    for (int j = 0; j <= i; ++j, in += 9) {
      hessian.template block<3, 3>(3 * i, 3 * j) = Eigen::Map<const Mat3>(in);
      hessian.template block<3, 3>(3 * j, 3 * i) = Eigen::Map<const Mat3>(in).transpose();
    }
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(Matrix(basis.transpose() * hessian * basis));
  if (eigen.info() != Eigen::Success || eigen.eigenvalues()(0) >= 0) return;
  const Matrix vectors = basis * eigen.eigenvectors();
  Matrix after = Matrix::Zero(3 * arity, 3 * arity);
  for (Eigen::Index k = 0; k < eigen.eigenvalues().size(); ++k)
    after += projected(eigen.eigenvalues()(k), projection) * vectors.col(k) * vectors.col(k).transpose();
  for (int i = 0; i < arity; ++i)
    for (int j = 0; j <= i; ++j, slots += 9) Eigen::Map<Mat3>{slots} = after.template block<3, 3>(3 * i, 3 * j);
}

}  // namespace

void project_mixed_psd(int arity, int scalars, double* slots, Projection projection) {
  if (projection == Projection::none) return;
  if (arity <= largest_arity)
    project<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3 * largest_arity, 3 * largest_arity>>(arity, scalars, slots, projection);
  else
    project<Eigen::MatrixXd>(arity, scalars, slots, projection);
}

}  // namespace tack
