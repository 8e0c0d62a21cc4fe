// Checks for elements that cannot act in contact: rods without width and particles without
// cross-section, which neither barrier nor adhesion would act on.
#pragma once

#include <string>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Throws InputError with the object and the indices of the elements, if the mesh has elements that
// need a section or radius that the object does not give.
void refuse_unmeasured_contact(const Mesh& mesh, const std::string& object, bool has_section,
                               bool has_radius);

}  // namespace tack
