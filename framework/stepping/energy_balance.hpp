// Where the energy of each step came from and went. Of the free vertices' kinetic energy and gravity and
// of all elastic and contact energies, E, a step changes
//     E' - E = loads + script + healing - friction - adhesion - plastic - damping - areas - numerics,
//   loads     the work of external loads, with the mean of their forces at both ends,
//   script    that of the forces which hold or move scripted vertices: the mean of the elastic and contact
//             forces at both ends, and friction and damping, times their displacement; and the energy that vertices
//             bring along when they are released, or take along when they are seized,
//   healing   what bonds that heal under pressure put into what they store,
//   friction  what sliding dissipated: force times slip, which is never negative,
//   adhesion  the same of tangential adhesion, and what bonds dissipate when they give way,
//   plastic   work of plastic flow, stress times plastic strain: also what hardening takes, which nothing gives back,
//   damping   what the damping of objects took: C v . v h with the step's mean velocities, never negative,
//   areas     what contact lost (or, below zero, gained) when its areas were taken anew at the start of the
//             step, with nothing moving, beyond what the forces of covered areas (contact/overlap_boundary_term.hpp), which are a part of its
//             energy at the end of a step, account for,
//   numerics  the rest: what the integrator lost or, below zero, made. Of implicit Euler in a linear
//             problem it is 1/2 |v' - v|_M^2 + 1/2 |x' - x|_K^2.
// healing to damping are what terms publish (core/records.hpp); others of theirs count likewise, by their kind.
// Of what contact's energy changes by, the forces of covered areas did `rim`: what adheres pulls what it covers in.
// Gravity is a potential here, loads are work. Normal adhesion is a potential: what detaching dissipates is
// what its energy rises by, until areas that come back at zero gap give it back.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/stepping/energy_flows.hpp"
#include "framework/stepping/group_balance.hpp"
#include "framework/world/world.hpp"

namespace tack {

class IncrementalPotential;
class Minimizer;

class EnergyBalance {
 public:
  using Energies = std::vector<NamedEnergy>;  // world/energy_records.hpp

  EnergyBalance(const World& world, const Minimizer& solver);

  // Starts a step from `state`: contact has taken its areas, who is held is known, nothing has moved.
  // to_places: the script moves vertices in this step, so that its first evaluation is elsewhere.
  void begin(const State& state, bool to_places);
  // The step is going to be kept and ends at x, where the terms still hold what they held in it.
  void end(const VecX& x);
  // The step from begin()'s state to `state`, which has those energies, is kept; end() has been called. script_moves: whether the
  // script may move vertices, in this or another step.
  EnergyFlows close(State& state, const Energies& energies, double h, bool script_moves,
                    IncrementalPotential& potential);
  // What is to be told of the step, or "": that for steps on end there has been a tenth more energy than nothing but
  // faults put in. Once in a run; what is less, or passes, is for its end (output/energy_losses.hpp).
  const std::string& warning() const { return warning_; }
  // Whether time integration lost more than half a hundredth of it in the step, below all that there was before.
  bool lost() const { return lost_; }
  // Of the groups of EnergyFlows::groups; known once a step has begun.
  const std::vector<std::string>& group_names() const { return groups_.names(); }

 private:
  void open(const State& state);
  double contact_at(const VecX& x) const;
  double contact_at_start(const VecX& start, const VecX& end, const IncrementalPotential& potential) const;
  void add_stored_gradient(const VecX& x, VecX& gradient, IncrementalPotential* potential) const;
  double load_work(const State& state, const VecX& way, double h);
  void add_inertia_and_weight(const State& state, VecX& gradient) const;
  double script_work(const VecX& way, const VecX& gradient, const VecX& x);
  bool watch(EnergyAccount& account, const EnergyFlows& flows);
  void warn_of_growth(EnergyAccount& account, const State& state, const EnergyFlows& flows);
  double solver_noise() const;

  const World& world_;
  const Minimizer& solver_;
  GroupBalance groups_;
  EnergyAccount start_;         // of the state that the step starts from
  double released_ = 0;         // J: the energy that a change of who is held brought along
  std::optional<double> contact_;  // J: contact energy at the start, with the areas of the step; if it is known
  EnergyFlows taken_;  // what end() found to be dissipated
  double jerk_ = 0;  // J: EnergyFlows::jerk
  std::string warning_;
  bool lost_ = false;
};

}  // namespace tack
