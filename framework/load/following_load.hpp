// A load whose force depends on where bodies are, or how fast: a term of the step's potential, held in it where it has none. Its value is no energy that
// bodies have; what it does to them is work.
#pragma once

#include <vector>

#include <optional>

#include "framework/core/dof_map.hpp"
#include "framework/core/residual_view.hpp"
#include "framework/core/term.hpp"

namespace tack {

class FollowingLoad : public Term, public ResidualView {
 public:
  using Term::Term;
  bool stores() const override { return false; }
  void publish(Records&) const override {}
  void begin_step(const StepStart& start) override {
    start_ = start.x;
    time_ = start.time;
    h_ = start.h;
  }
  // Before each begin_step(): the velocities at its start (3n) [m/s], and what an integrator takes for those at its end; of rate 0 where nothing has a velocity.
  virtual bool needs_velocities() const { return false; }
  virtual void know_velocities(const VecX& /*now*/, const EndVelocity& /*later*/) {}

  // The times at which it changes abruptly [s]: steps that adapt end there.
  virtual std::vector<double> corners() const { return {}; }

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

 private:
  VecX start_;
  double time_ = 0, h_ = 0;
};

}  // namespace tack
