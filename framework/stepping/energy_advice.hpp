// Advice on numerical energy gain or loss of steps. TimeIntegrator::energy_advice has that on time
// integration.
#pragma once

namespace tack {

inline constexpr const char* areas_advice =
    "overlap areas are re-evaluated in every step; if half the time.step does not help, they jump "
    "where regions of surfaces change their nearest ones: refine the meshes there, or add damping";
inline constexpr const char* repeats_advice =
    "steps with a numerical energy gain were repeated with implicit Euler, which damps: refine "
    "time.step";

}  // namespace tack
