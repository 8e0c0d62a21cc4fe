// An isotropic energy as squares: for psi(s) = 1/2 sum_i g(s_i)^2 + 1/2 v(J)^2, with g rising
// through g(1) = 0, the ten residuals of a tet are
//     sqrt(volume) (U diag(g(s)) V^T, v(J)),    F = U diag(s) V^T, J = det F.
// The first nine are an isotropic function of F, as smooth as g: in the principal frame its
// derivative is g'(s_i) on the diagonal, and for i != j the difference quotients (g_i - g_j)/(s_i -
// s_j) and (g_i + g_j)/(s_i + s_j) on the symmetric and the antisymmetric part. A material has
// RootSample stretch_root(double s) const  for g and  volume_root(double j) const  for v.
#pragma once

#include <cmath>

#include <Eigen/LU>

#include "energies/solid/svd3.hpp"
#include "energies/solid/tet_geometry.hpp"

namespace tack {

// A function of one argument and its slope [Pa^1/2].
struct RootSample {
  double value, slope;
};

inline constexpr int tet_residual_count = 10;

// r: 10; jacobian: 10 x 12, row-major, or null. False if the tet is inverted.
template <class Material>
bool tet_residuals(const Material& material, const TetRest<double>& rest, const Mat3& f, double* r,
                   double* jacobian) {
  if (!(f.determinant() > 0)) return false;
  const Svd3<double> svd = svd3(f);
  const Vec3& s = svd.s;
  const double root_volume = std::sqrt(rest.volume), det = s.prod();
  Vec3 g, slope;
  for (int i = 0; i < 3; ++i) {
    const RootSample root = material.stretch_root(s(i));
    g(i) = root.value;
    slope(i) = root.slope;
  }
  const RootSample volume = material.volume_root(det);
  Eigen::Map<Mat3> stretch(r);
  stretch = root_volume * svd.u * g.asDiagonal() * svd.v.transpose();
  r[9] = root_volume * volume.value;
  if (!std::isfinite(stretch.sum() + r[9])) return false;
  if (!jacobian) return true;

  Mat3 same = Mat3::Zero(), cross = Mat3::Zero();  // of the entries (ij) and (ji)
  for (int i = 0; i < 3; ++i) {
    same(i, i) = slope(i);
    for (int j = 0; j < i; ++j) {
      const double gap = s(i) - s(j);
      const bool close = std::abs(gap) < 1e-6 * (s(i) + s(j));
      const double strain = close ? 0.5 * (slope(i) + slope(j)) : (g(i) - g(j)) / gap;
      const double spin = (g(i) + g(j)) / (s(i) + s(j));
      same(i, j) = same(j, i) = 0.5 * (strain + spin);
      cross(i, j) = cross(j, i) = 0.5 * (strain - spin);
    }
  }
  using Rows = Eigen::Matrix<double, tet_residual_count, 12, Eigen::RowMajor>;
  Eigen::Map<Rows> out(jacobian);
  for (int a = 0; a < 3; ++a) {
    const Vec3 p = svd.v.transpose() * rest.shape.row(a).transpose();
    for (int c = 0; c < 3; ++c) {
      const Mat3 df = svd.u.row(c).transpose() * p.transpose();  // dF of one coordinate, U^T dF V
      const Mat3 dg = same.cwiseProduct(df) + cross.cwiseProduct(df.transpose());
      const Mat3 turned = root_volume * svd.u * dg * svd.v.transpose();
      const int column = 3 * (a + 1) + c;
      out.col(column).head<9>() = Eigen::Map<const Vec9>(turned.data());
      out(9, column) = root_volume * volume.slope * det * df.diagonal().cwiseQuotient(s).sum();
    }
  }
  for (int c = 0; c < 3; ++c) out.col(c) = -(out.col(3 + c) + out.col(6 + c) + out.col(9 + c));
  return true;
}

}  // namespace tack
