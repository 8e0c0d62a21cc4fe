// Equations of a step along an equilibrium path. Unknowns are q and the load time t, at which
// prescribed motion and dead loads are taken:
//     g(q, t) = 0,   c(q, t) = length of the step,
// with g the gradient of the incremental potential. The constraint c is one of
//   load_time    t - t_n
//   dissipation  sum_k [P_k(x) - P_k(x_n)] over the dynamic terms: contact, adhesion, bonds [J].
//                They are incremental potentials, so that this is the work that opening and damage
//                take: the work of loads and prescribed motion less the change of the elastic
//                energy of objects, the dissipation of Verhoosel et al. 2009
//   arc_length   sqrt(sum_v m_v |x_v - x_v,n|^2 / sum_v m_v): mass-weighted RMS displacement [m]
// Derivatives by t at fixed q are central differences.
#pragma once

#include <vector>

#include "framework/stepping/stepper.hpp"
#include "framework/world/step_potential.hpp"
#include "framework/world/world.hpp"

namespace tack {

enum class PathConstraint { load_time, dissipation, arc_length };

// Point of a path.
struct PathPoint {
  VecX q;
  double load_time = 0;  // s
};

class PathEquations {
 public:
  // load_time: at the start of the step [s].
  PathEquations(World& world, const Step& step, double load_time);

  // Returns the start of the step.
  const PathPoint& start() const { return start_; }
  // Returns the configuration of a point (3n) [m].
  VecX configuration(const PathPoint& point) const;
  // Moves all participants to a point.
  void move_to(const PathPoint& point);

  // Value of a constraint.
  double value(PathConstraint constraint, const PathPoint& point);
  // Derivatives at a point, at which the participants must be; leaves them close to it.
  struct Derivatives {
    VecX gradient_by_time;          // dg/dt
    VecX constraint_by_q;           // dc/dq
    double constraint_by_time = 0;  // dc/dt
  };
  Derivatives derivatives(PathConstraint constraint, const PathPoint& point);

 private:
  double dynamic_energy();
  double distance(const VecX& x) const;

  World& world_;
  const Step& step_;
  const VecX& start_x_;
  PathPoint start_;
  double load_time_;                // of the participants [s]
  std::vector<int> dynamic_parts_;  // of the potential
  double start_energy_ = 0;         // of the dynamic terms [J]
  double total_mass_;               // kg
};

}  // namespace tack
