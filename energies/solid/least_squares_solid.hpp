// Solid of one elastic material as a sum of squares (solid_residuals.hpp). The material has
//   RootSample stretch_root(double s) const, volume_root(double j) const
// in addition to the members that SolidTerm requires.
#pragma once

#include <atomic>

#include "energies/solid/solid_residuals.hpp"
#include "energies/solid/solid_term.hpp"
#include "framework/core/residual_view.hpp"

namespace tack {

template <class Material>
class LeastSquaresSolid : public SolidTerm<Material>, public ResidualView {
 public:
  using SolidTerm<Material>::SolidTerm;

  // A negative lambda is no sum of squares.
  const ResidualView* residual_view() const override {
    return this->material_.lame.lambda >= 0 ? this : nullptr;
  }

  std::vector<ResidualBatch> residual_batches() const override {
    const StencilBatch tets = this->batches().front();
    return {{tets.arity, tet_residual_count, tets.count, tets.vertices}};
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
    return finite;
  }
};

}  // namespace tack
