// Objects with `surface`: a contact surface finer than the mesh (geometry/mesh/refine_surface.hpp).
// Its new vertices depend on the corners of the mesh triangle that they lie in.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

// Appends the new vertices of body `index` to the world's; all mesh vertices must be there. Throws
// InputError if there would be too many, or the body has no surface triangles.
void add_refined_surface(const ObjectConfig& object, int index, World& world);

// Returns the finer surface of a body as a triangle mesh: vertices of its own mesh from 0, then the
// new ones.
Mesh surface_mesh(const Body& body, const VecX& rest);

}  // namespace tack
