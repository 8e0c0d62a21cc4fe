// Effective stiffness of sheets in contact. Young's modulus describes their stretch; stacked sheets
// of polyethylene, paper or steel all press with a few pascals.
#pragma once

#include <vector>

#include "framework/scene/scene_config.hpp"
#include "framework/setup/loading.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Returns, per body, the modulus from which its barrier is chosen, to two digits [Pa]. It is 0 for
// bodies that are no sheet, for sheets that are never free, and for sheets that a motion, load,
// attachment or interaction may stretch to the limits of their material.
// A tenth of the modulus, the default barrier, is the sum of:
//    100 times the pressure on the sheet's area of the weight of all that may meet it and of the
//        force that stops the sheet within a step at the speed that something may reach, and
//    the pressure of a strain of 1e-3 around a radius of a tenth of the sheet's size.
std::vector<double> sheet_stiffnesses(const SceneConfig& scene, const World& world,
                                      const std::vector<Loading>& loadings, double step);

}  // namespace tack
