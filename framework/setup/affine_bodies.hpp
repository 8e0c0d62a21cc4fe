// Objects with `body: affine`: their frames, masses and stiffness (framework/affine).
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/setup/loading.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Appends the frame of body `index` to the vertices of the world, whose mesh vertices are all
// there. Throws InputError if it encloses no volume.
void add_frame(const ObjectConfig& object, int index, World& world);

// Masses and the orthogonality term, once masses of all bodies have a place. The default stiffness
// is what the largest stress that bodies in reach may cause (loading.hpp) strains by 1e-4: their
// weight on the smallest face of the body, and what stops it within a step at the speed that it may
// reach.
void add_affine_masses(const ObjectConfig& object, int index, World& world);
void add_affine_terms(const SceneConfig& scene, const Value& root, const RunTimes& times,
                      World& world);

}  // namespace tack
