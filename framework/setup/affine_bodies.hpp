// Frames, masses and stiffness of objects with `body: affine` (framework/affine).
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/setup/loading.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Appends the frame of body `index` to the world's vertices; all mesh vertices must be there.
// Throws InputError if the body encloses no volume.
void add_frame(const ObjectConfig& object, int index, World& world);

// add_affine_masses: adds the masses of a frame. add_affine_terms: adds the orthogonality term,
// once all masses are there.
// The default stiffness allows a strain of 1e-4 under the largest stress that bodies in range may
// cause (loading.hpp): their weight on the smallest face of the body, plus the stress that stops
// the body within a step at the speed it may reach.
void add_affine_masses(const ObjectConfig& object, int index, World& world);
void add_affine_terms(const SceneConfig& scene, const Value& root, const RunTimes& times,
                      World& world);

}  // namespace tack
