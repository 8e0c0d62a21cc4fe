#include "energies/solid/neo_hookean.hpp"

namespace tack {

using NeoHookeanSolid = IsotropicSolid<NeoHookean>;
TACK_REGISTER(Energy, NeoHookeanSolid, "neo_hookean", "Neo-Hookean solid that cannot invert.",
              "Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 6.4.3");

}  // namespace tack
