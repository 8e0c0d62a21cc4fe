// Tets with patches, of one elastic material, as a sum of squares: the residuals of psi_s in each
// tet (solid_residuals.hpp), and sqrt(V) g(J) of each patch, U = g^2 / 2.
#pragma once

#include <atomic>

#include "energies/solid/patch_term.hpp"
#include "energies/solid/solid_residuals.hpp"
#include "framework/core/residual_view.hpp"

namespace tack {

template <class Shape, class Volume>
class PatchSolid : public PatchTerm<Shape, Volume>, public ResidualView {
 public:
  using PatchTerm<Shape, Volume>::PatchTerm;

  // A negative lambda, which stays with the shape, is no sum of squares.
  const ResidualView* residual_view() const override {
    return this->material_.lame.lambda >= 0 ? this : nullptr;
  }

  std::vector<ResidualBatch> residual_batches() const override {
    std::vector<ResidualBatch> all;
    for (const StencilBatch& b : this->batches())
      all.push_back({b.arity, all.empty() ? tet_residual_count : 1, b.count, b.vertices});
    return all;
  }

  bool residuals(const VecX& x, double* r, double* jacobian) const override {
    std::atomic<bool> finite = true;
    for_each(this->count(), [&](int t) {
      const size_t at = static_cast<size_t>(t) * tet_residual_count;
      const TetRest<double> rest = this->rest_of(t);
      if (!tet_residuals(this->material_, rest, deformation_gradient(rest, this->tets_[t], x),
                         r + at, jacobian ? jacobian + 12 * at : nullptr))
        finite = false;
    });
    if (!finite) return false;
    r += static_cast<size_t>(this->count()) * tet_residual_count;
    if (jacobian) jacobian += static_cast<size_t>(this->count()) * tet_residual_count * 12;
    for (int p = 0; p < this->patches_.count(); ++p) {
      const Patches::Patch& patch = this->patches_.patch(p);
      const double j = 1 + this->patches_.growth(p, x), root = std::sqrt(patch.volume);
      *r++ = root * this->law_.root(j);
      if (!jacobian) continue;
      this->patches_.derivative(p, x, jacobian);
      for (int i = 0; i < 3 * patch.size; ++i) *jacobian++ *= root * this->law_.root_slope(j);
    }
    return true;
  }
};

}  // namespace tack
