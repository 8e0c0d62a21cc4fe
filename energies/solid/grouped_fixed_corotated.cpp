#include "energies/solid/fixed_corotated.hpp"

#include "energies/solid/grouped_solid.hpp"

namespace tack {

template std::unique_ptr<Term> make_grouped_solid<FixedCorotated>(const std::string& name, const FixedCorotated& material, const Body& body, const VecX& rest);

}  // namespace tack
