// Checks of what cannot act in contact: rods without width and particles without cross-section,
// which neither barrier nor adhesion would act on, and features that the contact model does not
// support.
#pragma once

#include <string>
#include <string_view>

#include "framework/contact/contact_potential.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

// Throws InputError with the object and the indices of the elements, if the mesh has elements that
// need a section or radius that the object does not give.
void refuse_unmeasured_contact(const Mesh& mesh, const std::string& object, bool has_section,
                               bool has_radius);

// Returns the message that a contact model does not support a feature of an entry of contact.pairs,
// with the remedy. reason: ContactPotential::refusal.
std::string unsupported_text(ContactFeature feature, std::string_view model,
                             const std::string& reason);

}  // namespace tack
