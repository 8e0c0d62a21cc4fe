#include "framework/experiment/built_experiment.hpp"

#include "framework/experiment/tolerances.hpp"
#include "framework/scene/build_world.hpp"

namespace tack {

BuiltExperiment::BuiltExperiment(LoadedExperiment loaded) : loaded_(std::move(loaded)) {
  const Experiment& e = loaded_.experiment;
  world_ = build_world(e, loaded_.root, e.time.step, clock_);
  at_place(loaded_.root.find("solver"), [&] { e.solver->admit(world_->terms, world_->dofs.size()); });
  loaded_.experiment.solver = settled_solver(e, *world_, clock_);
}

ProbeSet probes_of(const BuiltExperiment& built) {
  ProbeSet probes(built.experiment().probes, built.root(), built.world());
  probes.check(built.experiment().expect, built.root());
  return probes;
}

}  // namespace tack
