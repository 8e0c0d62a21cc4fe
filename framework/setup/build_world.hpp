// Builds a world from the typed scene.
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

// Builds the world as it is before the first step of a run. The world refers to the scene:
//    root      the parsed file, for source locations in messages
//    earlier   the state that the scene's `start` names; null without
//    flowed    meshes of objects remeshed in a resumed run, whose start is past
// Throws InputError for any inconsistency, also for an initial configuration that intersects.
std::unique_ptr<World> build_world(const SceneConfig& scene, const Value& root,
                                   const RunTimes& times, PhaseClock& clock,
                                   const InitialStateFromRun* earlier = nullptr,
                                   const FlowedMeshes& flowed = {});

// Builds the pairs of objects and their laws (build_world_contact.cpp).
void build_contact(const SceneConfig& scene, const Value& root, const RunTimes& times,
                   PhaseClock& clock, World& world);

// Returns entry i of a list as in the file; null if there is no list.
const Value* entry_of(const Value* list, size_t i);

// Returns "scene.yaml:12:3: " for entry i of a list at the top level of the scene.
std::string source_location(const Value& root, const std::string& list, size_t i);

// Runs `action` and adds the source location of `value`, if known, to its InputErrors.
template <class Action>
void with_source_location(const Value* value, const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    throw InputError((value ? value->mark.text() + ": " : "") + error.what());
  }
}

}  // namespace tack
