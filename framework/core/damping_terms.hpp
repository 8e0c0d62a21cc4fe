// Rayleigh damping as a potential of a time step: for velocities v' = rate (x' - still) at its end, as the integrator
// takes them (EndVelocity),
//     P_d(x') = rate/2 (x' - still)^T C (x' - still),   of which the force is -C v',
// C = alpha M, or beta K with the elastic Hessians of the start of the step, clamped: positive semi-definite, and
// without effect on translations. C is held in the step, so that P_d is quadratic. It has the order of the integrator but for K,
// which is one step old.
#pragma once

#include "framework/core/term.hpp"

namespace tack {

class DampingTerm : public Term {
 public:
  void begin_step(const StepStart& start) override;
  bool stores() const override { return false; }
  void publish(Records& records) const override;

  double value(const VecX& x) const override;
  std::vector<StencilBatch> batches() const override { return batches_; }
  void derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const override;

  // (x - x_n)^T C (x - x_n) / h: the work of the mean forces.
  double dissipated(const VecX& x) const;
  // Adds -C (x - x_n) / h, the mean forces of the step (3n) [N].
  void add_mean_forces(const VecX& x, VecX& forces) const;

 protected:
  explicit DampingTerm(std::vector<StencilBatch> batches);
  std::vector<double>& blocks() { return blocks_; }

 private:
  double square(const VecX& d) const;  // d^T C d

  std::vector<StencilBatch> batches_;
  std::vector<double> blocks_;  // C of each stencil, in the Hessian's slots [kg/s]
  VecX start_;                  // x_n
  double h_ = 0;                // s
  EndVelocity velocity_{};
};

// beta K of an elastic term, which must outlive it. beta: s.
class StiffnessDamping : public DampingTerm {
 public:
  StiffnessDamping(const Term& elastic, double beta);
  void begin_step(const StepStart& start) override;

 private:
  const Term& elastic_;
  double beta_;
  std::vector<double> gradient_;  // not used, but written
};

// alpha M of so many vertices from a first one on. mass: of all vertices [kg]; alpha: 1/s.
class MassDamping : public DampingTerm {
 public:
  MassDamping(int first_vertex, int count, const VecX& mass, double alpha);

 private:
  MassDamping(std::vector<int> vertices, const VecX& mass, double alpha);
  std::vector<int> vertices_;
};

}  // namespace tack
