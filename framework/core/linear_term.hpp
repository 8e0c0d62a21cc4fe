// A potential linear in the positions, -f . (x - x_ref): gravity and external loads. Measured from
// the start of the step, so that large constant parts do not drown the decrease of the energy.
#pragma once

#include "framework/core/residual_view.hpp"
#include "framework/core/term.hpp"

namespace tack {

/// Potential of constant forces.
class LinearTerm : public Term, public ResidualView {
 public:
  using Term::Term;

  void set_force(VecX force) { force_ = std::move(force); }  // N, 3n
  /// Sets the configuration of zero potential (3n) [m]
  void set_reference(VecX reference) { reference_ = std::move(reference); }
  const VecX& force() const { return force_; }
  const VecX& reference() const { return reference_; }

  double value(const VecX& x) const override {
    return force_.size() == 0 ? 0.0 : -force_.dot(x - reference_);
  }
  void add_linear_gradient(VecX& gradient) const override {
    if (force_.size() > 0) gradient -= force_;
  }

  /// Publishes nothing: the potential of external forces is no energy of a body.
  void publish(Records&) const override {}

  /// The view has no residuals; the whole potential is `rest`.
  const ResidualView* residual_view() const override { return this; }
  std::vector<ResidualBatch> residual_batches() const override { return {}; }
  bool residuals(const VecX&, double*, double*) const override { return true; }

 private:
  VecX force_;  // empty: none
  VecX reference_;
};

}  // namespace tack
