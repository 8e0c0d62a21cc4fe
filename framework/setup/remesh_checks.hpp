// Checks of objects that are remeshed as they flow (`remesh`).
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Throws InputError, with source location, for anything that cannot continue with other interior
// vertices and tetrahedra. Call it after all terms have published their records.
void check_remeshing(const SceneConfig& scene, const Value& root, const World& world);

// Reduces the vertices that a motion prescribes to those on the surface, because remeshing replaces
// interior vertices. Throws InputError with the motion's name if it prescribes interior vertices at
// the start of a run.
void drop_interior_vertices(const std::string& motion, const Body& body,
                            std::vector<int>& vertices);

// Returns true if any object may be remeshed.
bool any_remeshed(const SceneConfig& scene);

}  // namespace tack
