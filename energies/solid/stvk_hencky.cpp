#include "energies/solid/stvk_hencky.hpp"

namespace tack {

using StvkHenckySolid = IsotropicSolid<StvkHencky>;
TACK_REGISTER(Energy, StvkHenckySolid, "stvk_hencky",
              "St. Venant-Kirchhoff solid in Hencky strain.",
              "Li, Li, Jiang 2022, Energetically Consistent Inelasticity, section 4");

}  // namespace tack
