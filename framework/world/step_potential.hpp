// The incremental potential of a world's steps. All step participants move to a configuration
// before anything is evaluated there. Throws OutOfTime at the deadline.
#pragma once

#include "framework/assembly/incremental_potential.hpp"
#include "framework/world/world.hpp"

namespace tack {

class StepPotential : public IncrementalPotential {
 public:
  // All terms, over the unknowns of the present step.
  StepPotential(World& world, PhaseClock& clock)
      : StepPotential(world, clock, world.terms, world.dofs, world.mass) {}
  // The given terms and unknowns, which must outlive it. mass: per vertex [kg].
  StepPotential(World& world, PhaseClock& clock, std::vector<const Term*> terms, const DofMap& dofs,
                const VecX& mass)
      : IncrementalPotential(std::move(terms), dofs, mass, clock, [&world, &clock](const VecX& x) {
          clock.deadline().check();
          world.participants.move_to(x);
        }) {}
};

}  // namespace tack
