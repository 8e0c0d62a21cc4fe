// Why energy was made or lost, and what cures that; of time integration, TimeIntegrator::energy_advice knows.
#pragma once

namespace tack {

inline constexpr const char* areas_advice =
    "covered areas are taken anew in every step; if half the time.step does not help, they jump where parts of surfaces change their "
    "nearest ones: finer meshes there make that less, damping takes what it makes";
inline constexpr const char* repeats_advice =
    "steps that would have made energy were done again with implicit Euler, which damps: refine time.step";

}  // namespace tack
