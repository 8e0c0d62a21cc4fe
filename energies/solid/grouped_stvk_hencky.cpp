#include "energies/solid/stvk_hencky.hpp"

#include "energies/solid/grouped_solid.hpp"

namespace tack {

template std::unique_ptr<Term> make_grouped_solid<StvkHencky>(const std::string& name, const StvkHencky& material, const Body& body, const VecX& rest);

}  // namespace tack
