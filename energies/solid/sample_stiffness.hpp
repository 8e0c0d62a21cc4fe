// Stiffness of one sample of a deformation gradient F = U diag(s) V^T = sum_a x_a g_a^T, for
// several samples side by side:
//     K_ab = sum_jl (g_a)_j dP_.j/dF_.l (g_b)_l,
// from dP/dF in the principal frame. For stencils of many vertices: quantities of b alone
// are computed once for all a.
#pragma once

#include "energies/solid/principal.hpp"

namespace tack {

class SampleStiffness {
 public:
  SampleStiffness(const PackMat3& u, const PrincipalHessian& h) : u_(u), h_(h) {
    for (int j = 0; j < 3; ++j) {
      same_[j].setZero();
      for (int i = 0; i < 3; ++i)
        if (i != j) same_[j] += h.same(i, j) * (u.col(i) * u.col(i).transpose());
    }
  }

  // Sets b, with p = V^T g_b times a weight: K_ab = sum_j (V^T g_a)_j column(j).
  void set(const PackVec3& p) {
    for (int j = 0; j < 3; ++j) {
      PackVec3 stretched = PackVec3::Zero(), crossed = PackVec3::Zero();
      for (int k = 0; k < 3; ++k) {
        stretched += (h_.diagonal(j, k) * p(k)) * u_.col(k);
        if (k != j) crossed += (h_.cross(k, j) * p(k)) * u_.col(k);
      }
      column_[j] =
          u_.col(j) * stretched.transpose() + crossed * u_.col(j).transpose() + p(j) * same_[j];
    }
  }

  template <class Block>
  void add_to(Block& block, const PackVec3& a) const {
    for (int i = 0; i < 9; ++i)
      block(i) += a(0) * column_[0](i) + a(1) * column_[1](i) + a(2) * column_[2](i);
  }

 private:
  const PackMat3& u_;
  const PrincipalHessian& h_;
  std::array<PackMat3, 3> same_, column_;
};

// Adds the derivatives of p J, J = s_0 s_1 s_2, with a constant pressure p, to those of a density.
inline void add_pressure(PrincipalDerivatives& d, const PackVec3& s, const Pack& pressure) {
  const PackVec3 cofactor(s(1) * s(2), s(0) * s(2), s(0) * s(1));
  for (int i = 0; i < 3; ++i) {
    d.gradient(i) += pressure * cofactor(i);
    for (int k = 0; k < 3; ++k)
      if (k != i) d.hessian(i, k) += pressure * s(3 - i - k);
  }
}

}  // namespace tack
