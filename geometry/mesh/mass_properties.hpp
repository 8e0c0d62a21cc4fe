// Volume, centroid and second moments of the space that a mesh encloses: exact integrals over its
// tets or, without any, over the inside of its closed surface.
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

struct MassProperties {
  double volume = 0;             // m^3
  Vec3 centroid = Vec3::Zero();  // m
  Mat3 moments = Mat3::Zero();   // integral of (x - centroid) (x - centroid)^T [m^5]
};

// Returns the mass properties. Throws InputError if there are neither tets nor triangles, or if the
// surface is not closed, not consistently oriented, inside out, or has closed components within
// each other of which the inner one would count twice (a cavity faces inwards). Edges and points
// are ignored.
MassProperties mass_properties(const Mesh& mesh);

}  // namespace tack
