// What contact cannot take yet: rods and particles, whose points and edges stand for no area and so would
// feel neither barrier nor adhesion, and explicit triangles of an object that has tets, which would be left out.
#pragma once

#include <string>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Throws InputError, with the object and the numbers of such elements, if a mesh has any.
void refuse_unsupported_contact(const Mesh& mesh, const std::string& object);

}  // namespace tack
