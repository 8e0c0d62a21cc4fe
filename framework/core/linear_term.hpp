// A potential linear in the positions, -f . (x - x_ref): gravity and external loads. Measured from
// the start of the step, so that large constant parts do not drown the decrease of the energy.
#pragma once

#include "framework/core/local_stencils.hpp"
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

  bool lagged_stencils() const override { return true; }  // it has none
  double value(const VecX& x) const override {
    return force_.size() == 0 ? 0.0 : -force_.dot(x - reference_);
  }
  void add_linear_gradient(VecX& gradient) const override {
    if (force_.size() > 0) gradient -= force_;
  }

  std::unique_ptr<Term> restricted(const StencilChoice& choice) const override;

  /// Publishes nothing: the potential of external forces is no energy of a body.
  void publish(Records&) const override {}

  /// The view has no residuals; the whole potential is `rest`.
  const ResidualView* residual_view() const override { return this; }
  std::vector<ResidualBatch> residual_batches() const override { return {}; }
  bool residuals(const VecX&, double*, double*) const override { return true; }

 private:
  class LocalLinearTerm;

  VecX force_;  // empty: none
  VecX reference_;
};

/// Part of a linear term in a local problem.
class LinearTerm::LocalLinearTerm : public LinearTerm {
 public:
  LocalLinearTerm(const std::string& name, bool dynamic) : LinearTerm(name), dynamic_(dynamic) {}
  bool dynamic() const override { return dynamic_; }

 private:
  bool dynamic_;  // of the whole term
};

inline std::unique_ptr<Term> LinearTerm::restricted(const StencilChoice& choice) const {
  auto part = std::make_unique<LocalLinearTerm>(name(), dynamic());
  if (force_.size() == 0) return part;
  const auto chosen = [&](const VecX& of_all) {
    VecX own(3 * choice.vertices.count());
    for (int i = 0; i < choice.vertices.count(); ++i)
      vertex(own, i) = vertex(of_all, choice.vertices.global(i));
    return own;
  };
  part->set_force(chosen(force_));
  part->set_reference(chosen(reference_));
  return part;
}

}  // namespace tack
