#include "energies/solid/fixed_corotated.hpp"

namespace tack {

using FixedCorotatedSolid = IsotropicSolid<FixedCorotated>;
TACK_REGISTER(Energy, FixedCorotatedSolid, "fixed_corotated", "Fixed corotated solid; below a tenth of its volume a barrier keeps it from being crushed flat.",
              "Stomakhin et al. 2012, Energetically Consistent Invertible Elasticity");

}  // namespace tack
