// The incremental potential of the steps of a world. All that take part in them are told of each new configuration
// before anything is evaluated there, and time that is out ends it (OutOfTime).
#pragma once

#include "framework/assembly/incremental_potential.hpp"
#include "framework/world/world.hpp"

namespace tack {

class StepPotential : public IncrementalPotential {
 public:
  // Of all terms, over the unknowns of the present step.
  StepPotential(World& world, PhaseClock& clock)
      : StepPotential(world, clock, world.terms, world.dofs, world.mass) {}
  // Of these terms, over these unknowns, which must outlive it; mass: per vertex [kg].
  StepPotential(World& world, PhaseClock& clock, std::vector<const Term*> terms, const DofMap& dofs, const VecX& mass)
      : IncrementalPotential(std::move(terms), dofs, mass, clock, [&world, &clock](const VecX& x) {
          clock.deadline().check();
          world.participants.move_to(x);
        }) {}
};

}  // namespace tack
