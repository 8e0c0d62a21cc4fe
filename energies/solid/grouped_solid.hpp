// Elastic solids of grouped tets.
#pragma once

#include "energies/solid/composite_solid.hpp"
#include "energies/solid/isotropic_solid.hpp"
#include "energies/solid/patch_solid.hpp"

namespace tack {

/// Makes the term of a solid for its kind of elements.
template <SplitMaterial Material>
std::unique_ptr<Term> make_grouped_solid(const std::string& name, const Material& material,
                                         const Body& body, const VecX& rest) {
  if (body.elements == Elements::composite)
    return std::make_unique<CompositeSolid<Material>>(name, material, body, rest);
  const auto split = material.split();
  return std::make_unique<PatchSolid<decltype(split.shape), decltype(split.volume)>>(
      name, split.shape, split.volume, body, rest);
}

}  // namespace tack
