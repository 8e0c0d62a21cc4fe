#include "framework/experiment/built_experiment.hpp"

#include <fmt/format.h>

#include "framework/experiment/read_initial_state.hpp"
#include "framework/experiment/tolerances.hpp"
#include "framework/protocol/stage_metrics.hpp"
#include "framework/setup/build_world.hpp"
#include "framework/setup/remesh_checks.hpp"

namespace tack {
namespace {

void check_damping(const Experiment& e, const Value& root) {
  if (e.time.integrator->inertia()) return;
  for (size_t i = 0; i < e.objects.size(); ++i)
    if (e.objects[i].damping)
      throw InputError(fmt::format("{}object '{}': damping acts on velocities, and with time.integrator: {} there are none; take "
                                   "another integrator, or the damping out", source_location(root, "objects", i), e.objects[i].name,
                                   e.time.integrator->type()));
}

// Throws InputError at an expectation of a stage that no protocol has.
void check_stages(const Experiment& e, const Value& root) {
  for (size_t i = 0; i < e.expect.size(); ++i) try {
      if (!e.expect[i].stage.empty()) need_stage(e.protocols, e.expect[i].stage);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}expectation '{}': {}", source_location(root, "expect", i), name_of(e.expect[i]), error.what()));
    }
}

}  // namespace

BuiltExperiment::BuiltExperiment(LoadedExperiment loaded) : loaded_(std::move(loaded)) {
  const Experiment& e = loaded_.experiment;
  if (any_remeshed(e) && !e.output.gradients.empty())
    with_source_location(loaded_.root.find("output"), [] {
      throw InputError("output.gradients follow one mesh through the run, and objects may be meshed anew (remesh); take one of the two away");
    });
  if (e.start && !loaded_.initial_state) with_source_location(loaded_.root.find("start"), [&] { loaded_.initial_state = read_initial_state(e.start->from); });
  build();
  loaded_.initial_state.reset();
  loaded_.experiment.solver = solver_with_tolerances(e, *world_);
}

void BuiltExperiment::build() {
  const Experiment& e = loaded_.experiment;
  world_ = build_world(e, loaded_.root, {e.time.step, e.time.duration}, clock_, loaded_.initial_state ? &*loaded_.initial_state : nullptr, loaded_.flowed);
  check_damping(e, loaded_.root);
  with_source_location(loaded_.root.find("time"), [&] { e.time.stepper->admit(*world_, e, e.time); });
  world_->step_metrics = e.time.stepper->metrics();
  for (const ProtocolConfig& protocol : e.protocols) world_->step_metrics.push_back(stage_metric(protocol, 0));
  with_source_location(loaded_.root.find("solver"), [&] { e.solver->admit(world_->terms, world_->dofs.size()); });
}

std::unique_ptr<World> BuiltExperiment::rebuild(FlowedMeshes flowed) {
  loaded_.flowed = std::move(flowed);
  std::unique_ptr<World> before = std::move(world_);
  build();
  return before;
}

ProbeSet probes_of(const BuiltExperiment& built) {
  check_stages(built.experiment(), built.root());
  ProbeSet probes(built.experiment().probes, built.root(), built.world());
  probes.check(built.experiment().expect, built.root());
  return probes;
}

}  // namespace tack
