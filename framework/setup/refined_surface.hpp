// Objects with `surface`: contact sees a finer surface than that of their mesh (geometry/mesh/refine_surface.hpp), whose
// new vertices follow the corners of the triangle of the mesh that they lie in.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

// Appends the new vertices of body `index` to those of the world, whose mesh vertices are all there. Throws InputError if
// they would be too many, or the body shows no triangles.
void add_refined_surface(const ObjectConfig& object, int index, World& world);

// The finer surface of a body as a mesh of triangles: vertices of its own mesh from 0, then the new ones.
Mesh surface_mesh(const Body& body, const VecX& rest);

}  // namespace tack
