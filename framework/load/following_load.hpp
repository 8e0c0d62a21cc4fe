// A load whose force depends on where bodies are, or how fast: a term of the step's potential, held in it where it has none. Its value is no energy that
// bodies have; what it does to them is work.
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

  // For methods that want sums of squares, all of it is rest.
  const ResidualView* residual_view() const override { return this; }
  std::vector<ResidualBatch> residual_batches() const override { return {}; }
  bool residuals(const VecX&, double*, double*) const override { return true; }

  // Adds its forces at x when a part of the step is over, 0 at its start and 1 at its end (3n) [N].
  virtual void add_forces(const VecX& x, double part, VecX& forces) const = 0;
  // Its work on what moves in a step that ends at x, along the straight way there by Simpson's rule: exact for pressures [J].
  virtual double work(const VecX& x, const DofMap& dofs) const;

 protected:
  static double work_of(const VecX& forces, const VecX& way, const DofMap& dofs);  // on what moves
  const VecX& start() const { return start_; }  // of the step (3n) [m]
  double time() const { return time_; }         // of its start [s]
  double h() const { return h_; }               // its size [s]
  // Velocities at its start (3n) [m/s] and at its end: zero, and of rate 0, where nothing has any, or none are needed.
  const VecX& before() const { return before_; }
  const EndVelocity& after() const { return after_; }

 private:
  VecX start_;
  double time_ = 0, h_ = 0;
  VecX before_;
  EndVelocity after_{};
};

}  // namespace tack
