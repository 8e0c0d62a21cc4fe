// Terms of the contact model of a world, by their type.
#pragma once

#include "framework/contact/area_integral/overhang_term.hpp"
#include "framework/contact/area_integral/overlap_boundary_term.hpp"
#include "framework/contact/clipped/clipped_adhesion_term.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/contact/terms/contact_term.hpp"
#include "framework/world/world.hpp"
#include "tests/support/published.hpp"

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
// Overlap-boundary forces at x (3n) [N]: the constant ones and those of overhangs.
inline VecX overlap_boundary_forces(const World& world, const VecX& x) {
  return Published(*find_contact_term<OverlapBoundaryTerm>(world)).forces(x) +
         Published(*find_contact_term<OverhangTerm>(world)).forces(x);
}
// The same, of object b on object a [N].
inline Vec3 overlap_boundary_force(const World& world, const VecX& x, std::string_view summand,
                                   ObjectPair pair) {
  return Published(*find_contact_term<OverlapBoundaryTerm>(world)).force_between(x, summand, pair) +
         Published(*find_contact_term<OverhangTerm>(world)).force_between(x, summand, pair);
}
inline ClippedAdhesionTerm* clipped_adhesion(const World& world) {
  return find_contact_term<ClippedAdhesionTerm>(world);
}

// Returns the overlap of the surfaces in the present step.
inline const SurfaceOverlap& overlap(const World& world) {
  return dynamic_cast<const AreaIntegral&>(world.contact->potential()).overlap();
}

}  // namespace tack
