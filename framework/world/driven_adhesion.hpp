// Energy balance of adhesion whose factor follows a drive (setup/driven_law.hpp). A step has the
// factor of its end, so that the energy of adhesion changes at its start, with nothing moving, by
//     sum over pairs of (u(t + h) - u(t)) times the energy with the factor 1:
// work of the environment, as of bonds whose strength changes with time or temperature.
#pragma once

#include "framework/world/world.hpp"

namespace tack {

/// Name of the flow: what it feeds is a change of the contact energy at the start of the step, and
/// no part of `dissipated_areas`.
inline constexpr const char* driven_adhesion = "driven adhesion";

/// Adds the flow `work_environment` to the records, if an adhesion follows a drive. The world must
/// outlive its records.
void publish_driven_adhesion(World& world);

}  // namespace tack
