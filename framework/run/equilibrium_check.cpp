#include "framework/run/equilibrium_check.hpp"

#include <fmt/format.h>

#include "framework/stepping/force_groups.hpp"
#include "framework/stepping/free_bodies.hpp"
#include "framework/world/step_potential.hpp"

namespace tack {

EquilibriumCheck check_equilibrium(const Experiment& experiment, World& world, PhaseClock& clock) {
  const State& start = world.start;
  const double h = experiment.time.step;
  if (experiment.time.integrator->inertia() || world.dofs.size() == 0) return {};
  const auto prediction = experiment.time.integrator->predict({start, h});
  world.participants.load_history(start.history);
  world.participants.begin_step({start.x, start.time, h});
  StepPotential potential(world, clock);
  potential.begin_step(start.x, prediction.x, prediction.scales(), false);
  ForceGroups groups;
  groups.begin_unknowns(world, potential, rounding_forces(world));
  groups.begin_step(world);
  VecX q;
  world.dofs.gather(start.x, q);
  potential.move_to(q);
  const VecX gradient = potential.gradient() / potential.scale();
  groups.measure(potential);
  try {
    check_free_bodies(world, groups, start.x, gradient);
  } catch (const FreeBody& free) {
    return {fmt::format("{}; {}", free.what(), FreeBody::remedy), {}};
  }
  return {"", turning_bodies(world, groups, start.x, gradient)};
}

}  // namespace tack
