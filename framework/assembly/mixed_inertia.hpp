// Inertia of mixed vertices (DofMap::mixed: several unknowns move them), as a term in x:
//     1/2 sum_v m_v |x_v - x~_v|^2 / scale,
// where `scale` is the factor of terms in the potential.
#pragma once

#include <vector>

#include "framework/core/dof_map.hpp"
#include "framework/core/residual_view.hpp"
#include "framework/core/term.hpp"

namespace tack {

/// Inertia of the vertices that several unknowns move.
class MixedInertia : public Term, public ResidualView {
 public:
  // Includes mixed vertices with a mass. mass: per vertex [kg].
  MixedInertia(const VecX& mass, const DofMap& dofs);
  void set_mass(const VecX& mass);
  bool empty() const { return vertices_.empty(); }
  /// Begins a step. prediction: x~ (3n).
  void set_prediction(const VecX& prediction, double scale, bool inertia);

  double value(const VecX& x) const override;
  std::vector<StencilBatch> batches() const override;
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;

  const ResidualView* residual_view() const override { return this; }
  std::vector<ResidualBatch> residual_batches() const override;
  bool residuals(const VecX& x, double* r, double* jacobian) const override;

 private:
  std::vector<int> vertices_;
  VecX mass_, prediction_;  // of the vertices
  double factor_ = 1;
};

}  // namespace tack
