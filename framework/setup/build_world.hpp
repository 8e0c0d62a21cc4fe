// From the typed scene file to a world.
#pragma once

#include <memory>
#include <string>

#include "framework/body/flowed_mesh.hpp"
#include "framework/core/phase_clock.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/setup/loading.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {

struct InitialStateFromRun;

// Builds the world as it is before the first step of a run; it points into the scene. `root` is the
// parsed file, for places in messages. Throws InputError for anything that does not fit together,
// also for a start that intersects. `earlier`: the state that the scene's `start` speaks of; null
// without. `flowed`: the meshes of objects that were meshed anew in a run that is gone on with,
// whose start is behind it.
std::unique_ptr<World> build_world(const SceneConfig& scene, const Value& root,
                                   const RunTimes& times, PhaseClock& clock,
                                   const InitialStateFromRun* earlier = nullptr, const FlowedMeshes& flowed = {});

// The pairs of objects and their laws (build_world_contact.cpp).
void build_contact(const SceneConfig& scene, const Value& root, const RunTimes& times,
                   PhaseClock& clock, World& world);

// Entry i of a list as it stands in the file; null if the list is not there.
const Value* entry_of(const Value* list, size_t i);

// "scene.yaml:12:3: " of entry i of a list at the top of the scene, for messages.
std::string place_of(const Value& root, const std::string& list, size_t i);

// Runs an action whose messages lack a place with that of a value, if it is known.
template <class Action>
void at_place(const Value* value, const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    throw InputError((value ? value->mark.text() + ": " : "") + error.what());
  }
}

}  // namespace tack
