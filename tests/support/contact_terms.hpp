// Terms of the contact model of a world, by their type.
#pragma once

#include "framework/contact/area_integral/overlap_boundary_term.hpp"
#include "framework/contact/clipped/clipped_adhesion_term.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/contact/terms/contact_term.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Returns the term of this type; null if there is none.
template <class T>
T* find_contact_term(const World& world) {
  if (world.contact)
    for (const auto& term : world.contact->potential().terms())
      if (T* found = dynamic_cast<T*>(term.get())) return found;
  return nullptr;
}

inline ContactTerm& contact_term(const World& world) {
  return *find_contact_term<ContactTerm>(world);
}
inline OverlapBoundaryTerm* overlap_boundary_term(const World& world) {
  return find_contact_term<OverlapBoundaryTerm>(world);
}
inline ClippedAdhesionTerm* clipped_adhesion(const World& world) {
  return find_contact_term<ClippedAdhesionTerm>(world);
}

// Returns the overlap of the surfaces in the present step.
inline const SurfaceOverlap& overlap(const World& world) {
  return dynamic_cast<const AreaIntegral&>(world.contact->potential()).overlap();
}

}  // namespace tack
