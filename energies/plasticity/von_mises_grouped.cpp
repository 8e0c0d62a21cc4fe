#include "energies/plasticity/von_mises_composite.hpp"
#include "energies/solid/patch_term.hpp"
#include "energies/plasticity/von_mises_term.hpp"

namespace tack {

std::unique_ptr<Term> make_grouped_von_mises(const std::string& name, const VonMises& material, const Body& body, const VecX& rest) {
  if (body.elements == Elements::composite) return std::make_unique<CompositeVonMises>(name, material, body, rest);
  const auto split = material.split();
  return std::make_unique<VonMisesTerm<PatchTerm<VonMises, LogVolume>>>(body, name, split.shape, split.volume, body, rest);
}

}  // namespace tack
