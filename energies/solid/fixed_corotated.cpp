#include "energies/solid/fixed_corotated.hpp"

namespace tack {

using FixedCorotatedSolid = IsotropicSolid<FixedCorotated>;
TACK_REGISTER(Energy, FixedCorotatedSolid, "fixed_corotated", "Fixed corotated solid, with a barrier below a tenth of its rest volume.",
              "Stomakhin et al. 2012, Energetically Consistent Invertible Elasticity");

}  // namespace tack
