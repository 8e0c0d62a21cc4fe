// Volume, centroid and second moments of the space that a mesh encloses: exact integrals over its
// tets or, without any, over the inside of its closed surface.
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

struct MassProperties {
  double volume = 0;               // m^3
  Vec3 centroid = Vec3::Zero();    // m
  Mat3 moments = Mat3::Zero();     // of (x - centroid) (x - centroid)^T over the volume [m^5]
};

// Throws InputError if there are neither tets nor triangles, or if the surface is not closed, not
// oriented alike throughout, inside out, or has closed parts within each other that would count the
// inner one twice (a cavity faces inwards). Edges and points are not asked.
MassProperties mass_properties(const Mesh& mesh);

}  // namespace tack
