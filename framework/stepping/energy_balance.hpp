// Energy balance of each step. Let E be the kinetic energy and gravity of the free vertices plus
// all elastic and contact energies. A step changes it by
//   E' - E = loads + prescribed motion + healing
//            - friction - adhesion - plastic - damping - areas - numerics.
//
//   loads     work of external loads, with the mean of their forces at both ends
//   prescribed motion
//             its work: the mean of the elastic and contact forces at both ends, plus friction and
//             damping, times the displacement of fixed vertices; and the energy that vertices add
//             when released, or remove when fixed
//   healing   energy that bonds store when they heal under pressure
//   friction  dissipation by sliding: force times slip, never negative
//   adhesion  dissipation by tangential adhesion, and by bonds that fail
//   plastic   work of plastic flow, stress times plastic strain, including hardening, which is
//             never given back
//   damping   dissipation by the damping of objects: C v . v h with the mean velocities of the
//             step, never negative
//   areas     contact energy lost (below zero: gained) when its areas were re-evaluated at the
//             start of the step, without motion, less the work of the overlap-boundary forces
//             (contact/area_integral/overlap_boundary_term.hpp), which is in the energy at the end
//             of a step
//   numerics  the remainder: numerical energy loss of the integrator (below zero: gain). For
//             implicit Euler in a linear problem it is 1/2 |v' - v|_M^2 + 1/2 |x' - x|_K^2.
//
// Terms publish the flows from healing to damping (core/records.hpp); further published flows count
// by their kind. Column `work_rim` is the work of the overlap-boundary forces within the change of
// the contact energy: adhering surfaces pull area into their overlap.
//
// Gravity is a potential here, loads are work. Normal adhesion is a potential: its energy rises by
// the work of detachment, and falls when areas return to zero gap.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/stepping/energy_flows.hpp"
#include "framework/stepping/group_balance.hpp"
#include "framework/stepping/stepper.hpp"
#include "framework/world/world.hpp"

namespace tack {

class IncrementalPotential;
class Minimizer;

class EnergyBalance {
 public:
  using Energies = std::vector<NamedEnergy>;  // world/energy_records.hpp

  EnergyBalance(World& world, const Minimizer& solver);

  // Begins a step from `state`: areas of contact are evaluated, fixed vertices are known, and
  // nothing has moved. has_prescribed_motion: a prescribed motion moves vertices in this step, so
  // that the potential is not first evaluated at `state`.
  void begin(const State& state, bool has_prescribed_motion);
  // Ends the step at x, before it is accepted; the terms must still be in the state of the step.
  void end(const VecX& x);
  // Accepts the step from the state of begin() to `state`, which has these energies, after end().
  // load_times: at which the loads of both ends are taken. motion_prescribed: whether a prescribed
  // motion may move vertices, in this or another step.
  EnergyFlows close(State& state, const Energies& energies, double h,
                    const Stepper::LoadTimes& load_times, bool motion_prescribed,
                    IncrementalPotential& potential);
  // Returns the warning of the step, or "". It is given once in a run, for a numerical energy gain
  // above a tenth of the reference energy in consecutive steps. Smaller or temporary gains are
  // reported at the end of the run (output/energy_losses.hpp).
  const std::string& warning() const { return warning_; }
  // Returns the names of the groups in EnergyFlows::groups; known once a step has begun.
  const std::vector<std::string>& group_names() const { return groups_.names(); }

 private:
  void open_account(const State& state);
  double contact_at(const VecX& x) const;
  double contact_at_start(const VecX& start, const VecX& end,
                          const IncrementalPotential& potential) const;
  void add_stored_gradient(const VecX& x, VecX& gradient, IncrementalPotential* potential) const;
  double load_work(const Stepper::LoadTimes& times, const VecX& displacement);
  void add_inertia_and_weight(const State& state, VecX& gradient) const;
  double prescribed_work(const VecX& displacement, const VecX& gradient, const VecX& x);
  void track_gain(EnergyAccount& account, EnergyFlows& flows) const;
  void warn_of_growth(EnergyAccount& account, const State& state, const EnergyFlows& flows);
  double solver_noise() const;

  World& world_;
  const Minimizer& solver_;
  GroupBalance groups_;
  EnergyAccount start_;            // at the start of the step
  double released_ = 0;            // energy added by released or fixed vertices [J]
  std::optional<double> contact_;  // contact energy at the start, with the areas of the step [J]
  double fed_at_start_ = 0;        // of it, fed by factors of adhesion [J]
  EnergyFlows dissipated_;         // set by end()
  double jerk_ = 0;                // EnergyFlows::jerk [J]
  std::string warning_;
};

}  // namespace tack
