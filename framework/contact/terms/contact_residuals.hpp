// Contact as least squares. With W, the depth of the law's well, a stencil has the energy
//     w m phi(d) = constant + w (m (phi + W) + (1 - m) W)
// and the residuals
//     points:  sqrt(w) rho(d)
//     edges:   sqrt(w m) rho(d),  sqrt(2 w W (1 - m))
// with rho of law_root.hpp; 1 - m = (1 - c/eps)^2 is a square. Stencils of negative weight
// (inclusion-exclusion) have zero residuals: they belong to the remaining energy.
#pragma once

#include <array>
#include <vector>

#include "framework/contact/contact_system.hpp"
#include "framework/contact/laws/law_root.hpp"
#include "framework/contact/stencils/stencil_kinds.hpp"
#include "framework/core/residual_view.hpp"

namespace tack {

class ContactResiduals : public ResidualView {
 public:
  explicit ContactResiduals(const ContactSystem& system) : system_(system) {}
  std::vector<ResidualBatch> residual_batches() const override;
  bool residuals(const VecX& x, double* r, double* jacobian) const override;

 private:
  void find_roots() const;

  const ContactSystem& system_;
  // Per law of the pair table; computed on first use, as few solvers need them.
  mutable std::vector<LawRoot> roots_;
  mutable std::array<std::vector<int>, stencil_kind_count> batch_vertices_;
};

}  // namespace tack
