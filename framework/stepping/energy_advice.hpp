// Advice on energy that a step gained or lost numerically. TimeIntegrator::energy_advice covers the
// part of time integration.
#pragma once

namespace tack {

inline constexpr const char* areas_advice =
    "covered areas are taken anew in every step; if half the time.step does not help, they jump "
    "where parts of surfaces change their "
    "nearest ones: finer meshes there make that less, damping takes what it makes";
inline constexpr const char* repeats_advice =
    "steps that would have made energy were done again with implicit Euler, which damps: refine "
    "time.step";

}  // namespace tack
