// What objects that are meshed anew as they flow (`remesh`) may be.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Throws InputError with the place in the file for what could not go on with other vertices and tets inside. After all terms have published.
void check_remeshing(const SceneConfig& scene, const Value& root, const World& world);

// Which of the vertices that a motion holds it may hold throughout: those on the surface, as others inside come and go. Throws InputError with the
// motion's name if it holds any inside when a run begins.
void keep_on_surface(const std::string& motion, const Body& body, std::vector<int>& vertices);

// Whether any object may be meshed anew.
bool remeshes(const SceneConfig& scene);

}  // namespace tack
