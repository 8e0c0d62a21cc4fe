// Advice on numerical energy gain or loss by areas of contact. For that of time integration, see
// TimeIntegrator::energy_advice.
#pragma once

namespace tack {

inline constexpr const char* areas_advice =
    "overlap areas are re-evaluated in every step; if half the time.step does not help, they jump "
    "where regions of surfaces change their nearest ones: refine the meshes there, or add damping";

}  // namespace tack
