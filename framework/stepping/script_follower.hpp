// Brings scripted vertices to their places at the end of a step, before the minimisation: the straight way if nothing
// is in it, a walk otherwise (script_walk.hpp).
#pragma once

#include <functional>
#include <optional>

#include "framework/assembly/incremental_potential.hpp"
#include "framework/core/state.hpp"
#include "framework/stepping/held_vertices.hpp"
#include "framework/stepping/iterate_check.hpp"
#include "framework/stepping/script_walk.hpp"

namespace tack {

class ScriptFollower {
 public:
  // straight, walk: the largest feasible steps along straight ways and of walks.
  ScriptFollower(World& world, const Minimizer& like, PhaseClock& clock, const HeldVertices& held,
                 ScriptWalk::LargestStep straight, ScriptWalk::LargestStep walk)
      : world_(world), like_(like), clock_(clock), held_(held), straight_(std::move(straight)), walks_(std::move(walk)) {}

  // Other vertices are held now.
  void reset() { walk_.reset(); }

  // From the state to a feasible start of the step of length h with the scripted vertices at their places, to which
  // they are moved in parts that turn nothing too far. potential: of this step; begun anew at the places.
  ScriptWalk::Result follow(const State& state, double h, const TimeIntegrator::Prediction& prediction,
                            IncrementalPotential& potential, IterateCheck* check,
                            const MinimizerProblem::Observer& observer);

 private:
  struct Step {
    int number;
    const TimeIntegrator::Prediction& prediction;
    IncrementalPotential& potential;
    IterateCheck* check;  // may be null
    const MinimizerProblem::Observer& observer;
  };
  ScriptWalk::Result move(const VecX& x, const VecX& places, const VecX& along, const Step& step);

  World& world_;
  const Minimizer& like_;
  PhaseClock& clock_;
  const HeldVertices& held_;
  ScriptWalk::LargestStep straight_, walks_;
  std::optional<ScriptWalk> walk_;  // made when it is first needed
};

}  // namespace tack
