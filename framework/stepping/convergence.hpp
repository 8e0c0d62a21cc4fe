// Convergence criterion of the minimisation of a step. It has two conditions:
//
// - The stopping norm (Stopping in framework/core/minimizer.hpp) is below its tolerance, including
//   the error of a direction that an iterative linear solver found. The residual r = -g - H p
//   leaves the error e = H^-1 r; with stencils made positive semi-definite H >= M, and for every
//   unknown i
//       |e_i| <= sqrt(r . M^-1 r / m_i).
// - The force residual is below its limit. At a very stiff contact or element a large force causes
//   a small displacement, which a norm of velocities does not notice. The force residual at a block
//   must be a small fraction of the reference force: the largest force of inertia, loads or
//   elements in its contact group (force_groups.hpp). Contact forces are no reference, because they
//   may be wrong themselves. A floor excludes the round-off of bodies without stress.
//
// Bodies outside of a contact group do not change its reference force. All bodies of a scene have
// one velocity tolerance: a tiny body costs the others at most a fifth of their iterations
// (docs/solvers.md).
#pragma once

#include <vector>

#include "framework/assembly/incremental_potential.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/stepping/force_groups.hpp"
#include "framework/world/world.hpp"

namespace tack {

class Convergence {
 public:
  // whole_step: step size of the scene [s]; force limits of substeps are no larger than its limits.
  Convergence(const World& world, const Minimizer& solver, double whole_step);

  // Called if the unknowns or the potential of the next step have changed.
  void begin_unknowns() { unknowns_known_ = false; }
  // Starts a step of size h [s]. The potential must have begun it.
  void begin_step(const IncrementalPotential& potential, double h, bool inertia);

  Stopping stopping() const { return inertia_ ? solver_.stopping() : Stopping::force; }
  // Returns the stopping norm of a direction p, given the gradient at its start; converged if it is
  // at most 1. Throws FreeBody if a step without inertia has no equilibrium (free_bodies.hpp).
  double norm(const VecX& p, const VecX& gradient);
  // Returns an upper bound of the norm of the exact direction less that of a direction with the
  // residual r.
  double direction_error(const VecX& r) const;

  // Largest component of the force residual at the block where it is largest over its limit, and
  // that limit [N].
  struct ForceResidual {
    double residual = 0, limit = 0;
  };
  // Returns the largest force residual over its limit, given the gradient at the present point of
  // the potential.
  double imbalance(const VecX& gradient);
  // Returns the last force residual of this step.
  const ForceResidual& force_residual() const { return force_residual_; }

  // Sets these criteria for a minimisation.
  void set_criteria(MinimizerProblem& problem);

 private:
  template <class Body>
  void for_each_mixed(const Body& body) const;
  double largest_displacement(const VecX& p) const;  // m
  double force_limit(int block) const;               // N
  void set_unknowns(const IncrementalPotential& potential);
  ForceResidual worst_residual(const VecX& gradient);

  const World& world_;
  const Minimizer& solver_;
  const double whole_step_;  // s

  const IncrementalPotential* potential_ = nullptr;
  bool unknowns_known_ = false;
  double h_ = 0;
  bool inertia_ = true;
  VecX mass_;                 // per block [kg]
  double smallest_mass_ = 0;  // of all blocks and mixed vertices [kg]
  VecX rounding_;             // rounding_forces()
  ForceGroups groups_;
  std::vector<ForceResidual> worst_of_chunk_;  // per chunk of blocks
  ForceResidual force_residual_;
};

}  // namespace tack
