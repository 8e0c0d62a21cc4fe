// What cannot act in contact: rods without a width and particles without a cross-section, which would feel neither
// barrier nor adhesion.
#pragma once

#include <string>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Throws InputError, with the object and the numbers of such elements, if a mesh has any that need the section, or the
// radius, that the object does not give.
void refuse_unmeasured_contact(const Mesh& mesh, const std::string& object, bool has_section, bool has_radius);

}  // namespace tack
