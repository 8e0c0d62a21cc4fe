#include "energies/solid/neo_hookean.hpp"

#include "energies/solid/grouped_solid.hpp"

namespace tack {

template std::unique_ptr<Term> make_grouped_solid<NeoHookean>(const std::string& name, const NeoHookean& material, const Body& body, const VecX& rest);

}  // namespace tack
