// The incremental potential of a world's steps. All step participants move to a configuration
// before anything is evaluated there. Throws OutOfTime at the deadline.
#pragma once

#include <memory>

#include "framework/assembly/incremental_potential.hpp"
#include "framework/assembly/stencil_maps.hpp"
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
      : IncrementalPotential(std::move(terms), dofs, mass, clock,
                             [&world, &clock](const VecX& x) {
                               clock.deadline().check();
                               world.participants.move_to(x);
                             }),
        world_(world), clock_(clock) {}

  // See framework/stepping/local_potential.hpp.
  std::unique_ptr<Objective> restricted(std::span<const int> blocks) override;
  // Returns the maps from vertices to stencils, made when they are first asked for.
  StencilMaps& stencil_maps() {
    if (!maps_) maps_ = std::make_unique<StencilMaps>(terms(), dofs());
    return *maps_;
  }

  // Configuration and displacements of all vertices (3n) [m], of which a local problem changes and
  // restores a few: making one costs no copy of all. x: at the current point.
  struct Scratch {
    VecX x, p;
    long moves = -1;  // of the potential at which x is
    bool taken = false;
  };
  Scratch& scratch() {
    if (scratch_.moves != moves()) {
      scratch_.x = configuration();
      scratch_.p.setZero(scratch_.x.size());
      scratch_.moves = moves();
    }
    return scratch_;
  }

 private:
  World& world_;
  PhaseClock& clock_;
  std::unique_ptr<StencilMaps> maps_;
  Scratch scratch_;
};

}  // namespace tack
