// Convergence criterion of the minimisation of a step. It has two conditions:
//
// - The stopping norm (Stopping in framework/core/minimizer.hpp) is below its tolerance, including
//   the error of a direction that an iterative linear solver found. The residual r = -g - H p
//   leaves the error e = H^-1 r; with stencils made positive semi-definite H >= M, and for every
//   unknown i
//       |e_i| <= sqrt(r . M^-1 r / m_i).
// - Forces balance. Where a contact or an element is very stiff, a large force moves nothing far,
//   and a norm of velocities is blind to it. The residual force at a block must be a small fraction
//   of the reference force: the largest force of inertia, loads or elements in its contact group
//   (force_groups.hpp). Contact forces are no reference: they may be wrong themselves. A floor
//   keeps out the round-off of bodies without stress.
//
// The reference force belongs to a contact group: bodies that do not touch it do not change it.
// The velocity tolerance is one for the scene: a tiny bystander costs the others at most a fifth of
// their iterations (docs/solvers.md).
#pragma once

#include <vector>

#include "framework/assembly/incremental_potential.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/stepping/force_groups.hpp"
#include "framework/world/world.hpp"

namespace tack {

class Convergence {
 public:
  // whole_step: step size of the scene [s]; substeps tolerate no larger forces.
  Convergence(const World& world, const Minimizer& solver, double whole_step);

  // Called when the next step has other unknowns, or another potential.
  void begin_unknowns() { unknowns_known_ = false; }
  // Starts a step of size h that the potential has begun.
  void begin_step(const IncrementalPotential& potential, double h, bool inertia);

  Stopping stopping() const { return inertia_ ? solver_.stopping() : Stopping::force; }
  // Returns the norm of a direction p, given the gradient where p starts; converged when not above
  // 1. Throws FreeBody where a step without inertia has no equilibrium (free_bodies.hpp).
  double norm(const VecX& p, const VecX& gradient);
  // Returns an upper bound of the increase of the norm from a direction that leaves the residual r
  // to the exact one.
  double direction_error(const VecX& r) const;

  struct Balance {
    // Largest component of the residual force at the block that is farthest from balance, and its
    // limit [N].
    double unbalanced = 0, tolerated = 0;
  };
  // Returns the residual force over its limit at the present point of the potential; gradient:
  // there.
  double imbalance(const VecX& gradient);
  const Balance& balance() const { return balance_; }  // last result of this step

  // Sets these criteria for a minimisation.
  void judge(MinimizerProblem& problem);

 private:
  template <class Body>
  void for_each_mixed(const Body& body) const;
  double largest_way(const VecX& p) const;     // m
  double tolerated_force(int block) const;     // N
  void take_unknowns(const IncrementalPotential& potential);
  Balance worst_balance(const VecX& gradient);

  const World& world_;
  const Minimizer& solver_;
  const double whole_step_;  // s

  const IncrementalPotential* potential_ = nullptr;
  bool unknowns_known_ = false;
  double h_ = 0;
  bool inertia_ = true;
  VecX mass_;                 // of each block [kg]
  double smallest_mass_ = 0;  // of all blocks and mixed vertices [kg]
  VecX rounding_;             // rounding_forces(); empty where the scene gives a floor
  ForceGroups groups_;
  std::vector<Balance> worst_of_chunk_;  // of blocks
  Balance balance_;
};

}  // namespace tack
