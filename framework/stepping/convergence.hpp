// When the minimisation of a step may end. Two things must hold:
//
// - The stopping norm (Stopping in framework/core/minimizer.hpp) is below its tolerance, whatever a direction
//   that was solved for by iterations may still miss. One that leaves the residual r = -g - H p misses e = H^-1 r;
//   where stencils are made positive semi-definite, H >= M, and for every unknown i
//       |e_i| <= sqrt(r . M^-1 r / m_i).
// - Forces balance. Where a contact or an element is very stiff, a large force moves nothing far, and a norm
//   of velocities is blind to it. What the forces at a vertex leave over must be a small part of the largest force
//   that has a cause: of inertia, loads or elements. Contact forces are no measure: they may be what is wrong.
//   A floor keeps the round-off of bodies without stress out of it.
#pragma once

#include "framework/assembly/incremental_potential.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/world/world.hpp"

namespace tack {

class Convergence {
 public:
  Convergence(const World& world, const Minimizer& solver) : world_(world), solver_(solver) {}

  // A step of size h that the potential has begun.
  void begin_step(const IncrementalPotential& potential, double h, bool inertia);

  Stopping stopping() const { return inertia_ ? solver_.stopping() : Stopping::force; }
  // Of a direction p and the gradient where it starts; converged when not above 1.
  double norm(const VecX& p, const VecX& gradient) const;
  // By how much the norm of the exact direction may exceed that of one that leaves the residual r.
  double direction_error(const VecX& r) const;

  struct Balance {
    double unbalanced = 0;  // the largest component of what is left over at any vertex [N]
    double tolerated = 0;   // N
  };
  // At the potential's present point; the gradient is its. In units of what is tolerated.
  double imbalance(const VecX& gradient);
  const Balance& balance() const { return balance_; }  // what was found last in this step

  // Has the minimisation judged by all that.
  void judge(MinimizerProblem& problem);

 private:
  template <class Body>
  void for_each_mixed(const Body& body) const;
  double largest_way(const VecX& p) const;           // m
  double largest_force(const VecX& gradient) const;  // N
  double tolerated_force() const;                    // N

  const World& world_;
  const Minimizer& solver_;

  const IncrementalPotential* potential_ = nullptr;
  double h_ = 0;
  bool inertia_ = true;
  VecX mass_;                 // of each block [kg]
  double smallest_mass_ = 0;  // likewise, or what a vertex that several move has of theirs
  double largest_load_ = 0;  // of a free vertex [N]
  Balance balance_;
};

}  // namespace tack
