// An experiment with its built world. The world points into the experiment (motions, loads): this
// class owns both at fixed addresses. Values that the experiment leaves open are filled in, and the
// experiment is constant from then on.
#pragma once

#include <memory>

#include "framework/core/phase_clock.hpp"
#include "framework/experiment/load_experiment.hpp"
#include "framework/output/probe_set.hpp"
#include "framework/world/world.hpp"

namespace tack {

class BuiltExperiment {
 public:
  // Builds the world. Throws InputError for inconsistent settings and for an intersecting initial
  // state.
  explicit BuiltExperiment(LoadedExperiment loaded);
  BuiltExperiment(const BuiltExperiment&) = delete;
  BuiltExperiment& operator=(const BuiltExperiment&) = delete;

  // With all tolerances of its solver.
  const Experiment& experiment() const { return loaded_.experiment; }
  // As parsed, for source locations in messages.
  const Value& root() const { return loaded_.root; }
  World& world() { return *world_; }
  const World& world() const { return *world_; }
  PhaseClock& clock() { return clock_; }

  // Builds the world again with the remeshed objects, and returns the previous world.
  std::unique_ptr<World> rebuild(FlowedMeshes flowed);
  const FlowedMeshes& flowed() const { return loaded_.flowed; }

 private:
  void build();

  PhaseClock clock_;
  LoadedExperiment loaded_;
  std::unique_ptr<World> world_;
};

// Returns the probes of an experiment, with its expectations checked against them. Throws
// InputError with the source location.
ProbeSet probes_of(const BuiltExperiment& built);

}  // namespace tack
