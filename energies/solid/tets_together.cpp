// Linked last: if several files define one inline function, the linker keeps the first copy, which then is that of linear tets.
#include "energies/solid/grouped_solid.hpp"

#include "energies/solid/fixed_corotated.hpp"
#include "energies/solid/neo_hookean.hpp"
#include "energies/solid/stvk_hencky.hpp"

namespace tack {

template std::unique_ptr<Term> make_grouped_solid(const std::string& name, const NeoHookean& material, const Body& body, const VecX& rest);
template std::unique_ptr<Term> make_grouped_solid(const std::string& name, const StvkHencky& material, const Body& body, const VecX& rest);
template std::unique_ptr<Term> make_grouped_solid(const std::string& name, const FixedCorotated& material, const Body& body, const VecX& rest);

}  // namespace tack
