// Gradient and Hessian of pack_width composite tets, per volume, summed sample by sample.
#pragma once

#include "energies/solid/composite_tets.hpp"
#include "energies/solid/principal.hpp"
#include "energies/solid/svd3.hpp"
#include "framework/core/term.hpp"

namespace tack {

class CompositeSums {
 public:
  static constexpr size_t gradient_size = 3 * composite_nodes,
                          hessian_size = 9 * hessian_blocks(composite_nodes);

  CompositeSums(const CompositeTets& tets, int pack, Projection projection, bool with_hessian);

  // A point at F = U diag(s) V^T with the derivatives of psi_s there, and the pressure of the mean
  // J.
  void add_point(int q, const Svd3<Pack>& svd, const PrincipalDerivatives& psi,
                 const Pack& pressure);
  void add_part(int s, const Svd3<Pack>& svd, const PrincipalDerivatives& psi);
  // Writes the first n; after all points and parts. bulk: U'' of the mean J.
  void store(const Pack& bulk, int n, double* gradient, double* hessian);

 private:
  auto slot(int a, int b) { return Eigen::Map<PackMat3>(slots_ + 9 * (a * (a + 1) / 2 + b)); }

  const CompositeTable& table_ = composite_table();
  const CompositeTets& tets_;
  int pack_;
  Projection projection_;
  bool with_hessian_;
  CompositeNodes gradient_, growth_;  // growth_: the derivative of the mean J
  alignas(64) Pack slots_[hessian_size];
};

}  // namespace tack
