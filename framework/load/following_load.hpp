// Load whose force depends on positions or velocities: a term of the potential of the step. Forces
// without a potential are lagged. The value is no stored energy; the load does work.
#pragma once

#include <vector>

#include "framework/core/dof_map.hpp"
#include "framework/core/residual_view.hpp"
#include "framework/core/term.hpp"

namespace tack {

class FollowingLoad : public Term, public ResidualView {
 public:
  using Term::Term;
  bool stores() const override { return false; }
  void publish(Records&) const override {}
  void begin_step(const StepStart& start) override;
  virtual bool needs_velocities() const { return false; }

  // Residual form: the load has no residuals, its potential is the remainder.
  const ResidualView* residual_view() const override { return this; }
  std::vector<ResidualBatch> residual_batches() const override { return {}; }
  bool residuals(const VecX&, double*, double*) const override { return true; }

  // Adds the forces at x at a fraction of the step, 0 at its start and 1 at its end (3n) [N].
  virtual void add_forces(const VecX& x, double fraction, VecX& forces) const = 0;
  // Returns the work on all moving vertices in a step that ends at x, along the linear trajectory,
  // by Simpson's rule [J]. It is exact for pressures.
  virtual double work(const VecX& x, const DofMap& dofs) const;

 protected:
  // Returns the work of constant forces on all moving vertices [J].
  static double work_of(const VecX& forces, const VecX& displacement, const DofMap& dofs);
  const VecX& start() const { return start_; }  // of the step (3n) [m]
  double time() const { return time_; }         // of its start [s]
  double h() const { return h_; }               // its size [s]
  // Velocities at the start (3n) [m/s] and at the end of the step; zero (rate 0) in quasi-static
  // steps and for loads that need none.
  const VecX& before() const { return before_; }
  const EndVelocity& after() const { return after_; }

 private:
  VecX start_;
  double time_ = 0, h_ = 0;
  VecX before_;
  EndVelocity after_{};
};

}  // namespace tack
