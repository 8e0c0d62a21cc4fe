// Objects that overlap at the start are moved out of each other, if the scene allows for it (contact.push_out).
//
// Whoever is free to go is translated along the signed distance of what it overlaps until a gap of half the contact distance
// (and the offsets) is there: where both may go, each by the share of the other's volume; pair by pair, in sweeps, so that a
// heap finds room; no object farther than the given length. Held by motions, attached, with something attached to it, or joined by
// an interaction: an object stays. All that follows (rest shapes, selections by place) sees objects where they then are.
#pragma once

#include <string>
#include <vector>

#include "framework/scene/scene_config.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

// Moves the meshes, one per object; one line for each that has gone, of more than ten the farthest and how many. Nothing without
// contact.push_out. Throws InputError, with the place of the later object, naming two that still overlap and why.
std::vector<std::string> push_out(const SceneConfig& scene, const Value& root, std::vector<Mesh>& meshes);

}  // namespace tack
