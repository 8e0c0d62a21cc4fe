// An experiment whose world is built. The world points into the experiment (motions, loads), so both are owned
// together and stay where they are; what the experiment left open is settled, and nothing of it changes any more.
#pragma once

#include <memory>

#include "framework/core/phase_clock.hpp"
#include "framework/experiment/load_experiment.hpp"
#include "framework/output/probe_set.hpp"
#include "framework/world/world.hpp"

namespace tack {

class BuiltExperiment {
 public:
  // Throws InputError for anything that does not fit together, also for a start that intersects.
  explicit BuiltExperiment(LoadedExperiment loaded);
  BuiltExperiment(const BuiltExperiment&) = delete;
  BuiltExperiment& operator=(const BuiltExperiment&) = delete;

  const Experiment& experiment() const { return loaded_.experiment; }  // its solver with all tolerances
  const Value& root() const { return loaded_.root; }                   // as parsed, for places in messages
  World& world() { return *world_; }
  const World& world() const { return *world_; }
  PhaseClock& clock() { return clock_; }

  // Builds its world again, with objects that have other meshes now, and returns the one before.
  std::unique_ptr<World> rebuild(FlowedMeshes flowed);
  const FlowedMeshes& flowed() const { return loaded_.flowed; }

 private:
  void build();

  PhaseClock clock_;
  LoadedExperiment loaded_;
  std::unique_ptr<World> world_;
};

// Its probes, ready, and its expectations checked against them. Throws InputError with the place in the file.
ProbeSet probes_of(const BuiltExperiment& built);

}  // namespace tack
