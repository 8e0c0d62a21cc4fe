// Checks of closed triangle surfaces.
#pragma once

#include "geometry/mesh/surface.hpp"

namespace tack {

// Every edge has exactly two triangles, which run along it in opposite directions.
bool is_closed_manifold(const std::vector<Triangle>& triangles);

// V - E + F: 2 for a sphere.
int euler_characteristic(const Surface& surface);

// Returns the volume by the divergence theorem; positive if the normals point outward.
double enclosed_volume(const Mesh& mesh, const std::vector<Triangle>& triangles);

}  // namespace tack
