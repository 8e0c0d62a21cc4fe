// Energy of the overhangs of all pairs (overhang.hpp). Overhangs are listed at the start of a step.
// To first order, the energy is the difference between the adhesion energy with the present areas
// and with those of the start of the step. It therefore counts as adhesion.
#pragma once

#include <vector>

#include "framework/contact/area_integral/overhang.hpp"
#include "framework/core/residual_view.hpp"
#include "framework/core/term.hpp"

namespace tack {

class AreaIntegral;

class OverhangTerm : public Term, public ResidualView {
 public:
  // The integral must outlive this term, and begin each step before it.
  explicit OverhangTerm(const AreaIntegral& integral);

  // Adhesion and the change of its area have one factor in every integrator (term_scales.hpp).
  bool dynamic() const override { return true; }
  bool lagged_stencils() const override { return true; }

  void clear_caches() override;
  void begin_step(const StepStart& start) override;

  double value(const VecX& x) const override;
  std::vector<StencilBatch> batches() const override;
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;
  std::unique_ptr<Term> restricted(const StencilChoice& choice) const override;
  bool visit_energies(const VecX& x, const EnergyVisitor& visit) const override;
  void publish(Records& records) const override;

  // The view has no residuals; the whole energy is `rest`.
  const ResidualView* residual_view() const override { return this; }
  std::vector<ResidualBatch> residual_batches() const override { return {}; }
  bool residuals(const VecX&, double*, double*) const override { return true; }

 protected:
  OverhangTerm() : Term("overhangs") {}
  void set(std::vector<Overhang> overhangs, VecX start);

 private:
  const AreaIntegral* integral_ = nullptr;  // null: of a local problem
  std::vector<Overhang> overhangs_;
  std::vector<int> vertices_;  // of all overhangs, six each
  VecX start_;                 // 3n [m]
};

}  // namespace tack
