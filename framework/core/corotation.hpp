// Displacement of a stencil from a reference s to x without its rotation:
//     u_i = R^T (x_i - c) - (s_i - c_s),
// R the rotation that minimises sum |u_i|^2, c and c_s the means; plus the translation c - c_s if
// the energy depends on it. For a pair or a line, the rotation about its axis is arbitrary. The
// gradient by x of any energy E(u) has no moment about x, because E is invariant to rotations of x.
// With f = dE/du and y_i = R^T (x_i - c), where sum s_i x y_i = 0 defines R,
//     A = sum (s_i . y_i) I - y_i s_i^T,   a = A^-1 sum y_i x f_i,   dE/dx_i = R (f_i - a x s_i),
// minus its mean. With the translation, the mean of f is added.
// Scalar dofs (StencilBatch::scalars) follow the positions and are not rotated.
#pragma once

#include "framework/core/term.hpp"

namespace tack {

/// Displacement of one stencil without its rotation.
class Corotation {
 public:
  static constexpr int most = 3 * largest_rank_one;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;

  // s, x: positions, then scalar dofs, three entries each. count: number of positions. translates:
  // u includes the translation.
  Corotation(int count, const Column& s, const Column& x, bool translates);

  const Column& u() const { return u_; }
  /// Returns the gradient by x of an energy with the gradient f by u.
  Column gradient(const Column& f) const;
  /// Returns du/dx.
  Square slopes() const;
  /// Returns the Hessian by x of an energy 1/2 u^T K u, f = K u. It may be indefinite. Near u = 0
  /// it tends to slopes^T K slopes, which is semi-definite if K is.
  Square hessian(const Square& k, const Column& f) const;

  /// Returns the field d of the positions s without its infinitesimal rotation about their mean.
  /// Scalar dofs are unchanged.
  static Column without_rotation(int count, const Column& s, const Column& d);

 private:
  Vec3 y(int i) const { return y_.segment<3>(3 * i); }
  Vec3 s(int i) const { return s_.segment<3>(3 * i); }

  int position_count_;
  double translation_;  // 1 if u includes the translation, else 0
  Column s_, y_, u_;    // s and y relative to their means
  Mat3 r_;
  Mat3 inverse_;  // of A; 0 about an axis about which the rotation is arbitrary
};

}  // namespace tack
