// Checks of what cannot act in contact: rods without width and particles without cross-section,
// which neither barrier nor adhesion would act on, and features that the contact model does not
// support.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "framework/contact/contact_potential.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

// Throws InputError with the object and the indices of the elements, if the mesh has elements that
// need a section or radius that the object does not give.
void refuse_unmeasured_contact(const Mesh& mesh, const std::string& object, bool has_section,
                               bool has_radius);

// Returns the message that the contact model of that name does not support a feature of a pair,
// with the remedy; "" if it does. objects: names of the two objects, or of the one that has rods or
// particles; empty: the feature is of all pairs.
std::string unsupported_text(const ContactPotential& potential, std::string_view model,
                             ContactFeature feature, const PairSetup& pair,
                             const std::vector<std::string>& objects);

}  // namespace tack
