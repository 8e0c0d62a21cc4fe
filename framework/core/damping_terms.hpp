// Rayleigh damping as a potential of a time step: for velocities v' = rate (x' - still) at its end,
// as the integrator takes them (EndVelocity),
//     P_d(x') = 1 / (2 rate) v'^T C v',   of which the force is -C v',
// C = alpha M, or beta K with the clamped elastic Hessians of the start of the step, which are
// positive semi-definite and lagged. The order is that of the integrator except for K, which is one
// step old.
//
// K damps the rate of strain and no rotation. Each stencil enters by its displacement u without
// rotation (corotation.hpp), from s to x', s being the start plus (still - start) without its
// infinitesimal rotation:
//     P_d(x') = rate/2 u^T C u.
// P_d does not change if x' is turned, so damping has no moment. P_d is zero where the integrator
// turns x' rigidly from the start. Terms that offer strains (strain_view.hpp), as rods do, enter by
// those: P_d(x') = beta rate/2 (e(x') - e_s)^T C (e(x') - e_s).
#pragma once

#include <algorithm>
#include <memory>

#include "framework/core/term.hpp"

namespace tack {

class StrainView;

/// Interface of damping terms.
class DampingTerm : public Term {
 public:
  void begin_step(const StepStart& start) override;
  bool stores() const override { return false; }
  void publish(Records& records) const override;

  /// Returns the energy that the step to x dissipates: the work of its mean forces [J], never
  /// negative.
  double dissipated(const VecX& x) const { return std::max(0.0, square(x, Reference::start) / h_); }
  /// Adds the mean forces of the step to x, those of P_d with v' = (x - x_n) / h (3n) [N].
  virtual void add_mean_forces(const VecX& x, VecX& forces) const = 0;

  double value(const VecX& x) const override {
    return begun() ? velocity_.rate / 2 * square(x, Reference::still) : 0;
  }

 protected:
  // Reference of displacements: the start of the step, or EndVelocity::still.
  enum class Reference { start, still };

  DampingTerm() : Term("damping") {}
  bool begun() const { return start_.size() > 0; }  // else nothing is damped
  // d^T C d of the displacement d to x [J s].
  virtual double square(const VecX& x, Reference from) const = 0;

  VecX start_;    // x_n
  double h_ = 0;  // s
  EndVelocity velocity_{};
};

/// Returns the damping beta K of an elastic term, which must outlive it. beta: s. Throws
/// std::logic_error for stencils of more than largest_arity vertices, or largest_rank_one vertices
/// if their Hessian is of rank one.
std::unique_ptr<DampingTerm> stiffness_damping(const Term& elastic, double beta);

/// Damping alpha M of `count` vertices from `first_vertex` on. mass: of all vertices [kg]; alpha:
/// 1/s.
class MassDamping : public DampingTerm {
 public:
  MassDamping(int first_vertex, int count, const VecX& mass, double alpha);

  std::vector<StencilBatch> batches() const override {
    return {{1, static_cast<int>(vertices_.size()), vertices_.data()}};
  }
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;
  void add_mean_forces(const VecX& x, VecX& forces) const override;

 private:
  double square(const VecX& x, Reference from) const override;

  std::vector<int> vertices_;
  std::vector<double> drag_;  // of each [kg/s]
};

}  // namespace tack
