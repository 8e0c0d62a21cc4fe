// How a stencil has deformed from a reference s to x, without its rotation and, if it is a pair or
// a line, without that about its axis:
//     u_i = R^T (x_i - c) - (s_i - c_s),
// R the rotation for which sum |u_i|^2 is least, c and c_s the means; and the translation c - c_s
// beside that, if the energy depends on it.
// For any energy E(u) the gradient by x has no moment about x, because E does not change if x is
// turned. With f = dE/du and y_i = R^T (x_i - c), where sum s_i x y_i = 0 defines R,
//     A = sum (s_i . y_i) I - y_i s_i^T,   a = A^-1 sum y_i x f_i,   dE/dx_i = R (f_i - a x s_i),
// less its mean. With the translation, the mean of f is added.
// Numbers (StencilBatch::twists), which come after the places, are not turned.
#pragma once

#include "framework/core/term.hpp"

namespace tack {

class Corotation {
 public:
  static constexpr int most = 3 * largest_rank_one;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;

  // s, x: of so many places, then numbers, three entries for each. translates: u has the
  // translation.
  Corotation(int places, const Column& s, const Column& x, bool translates);

  const Column& u() const { return u_; }
  // The gradient by x of an energy with the gradient f by u.
  Column gradient(const Column& f) const;
  // du/dx.
  Square slopes() const;
  // The Hessian by x of an energy 1/2 u^T K u, f = K u. Not definite: slopes^T K slopes, which is,
  // is what is left near u = 0.
  Square hessian(const Square& k, const Column& f) const;

  // The part of a field d of the places at s that is no infinitesimal rotation about their mean.
  // Numbers stay as they are.
  static Column without_rotation(int places, const Column& s, const Column& d);

 private:
  Vec3 y(int i) const { return y_.segment<3>(3 * i); }
  Vec3 s(int i) const { return s_.segment<3>(3 * i); }

  int places_;
  double translation_;  // 1 if u has it, else 0
  Column s_, y_, u_;  // s and y from their means
  Mat3 r_;
  Mat3 inverse_;      // of A; 0 about an axis about which nothing tells how the stencil has turned
};

}  // namespace tack
