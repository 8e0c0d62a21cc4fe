// How hard sheets are pressed: Young's modulus is that of their stretch, and sheets of
// polyethylene, paper or steel that lie on one another press with the same few pascals.
#pragma once

#include <vector>

#include "framework/scene/scene_config.hpp"
#include "framework/setup/loading.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Per body the modulus that is taken for it where a barrier is chosen, to two digits [Pa]; 0: no
// sheet that is ever free, or one that a script, a load, an attachment or an interaction may
// stretch as far as its material lets them. A tenth of it, the default barrier, is a hundred times
// the weight of all that may meet it on the area of the sheet and what stops the sheet within a
// step at the speed that something may reach; and what a strain of 1e-3 presses with around a tenth
// of the sheet's size.
std::vector<double> sheet_stiffnesses(const SceneConfig& scene, const World& world,
                                      const std::vector<Loading>& loadings, double step);

}  // namespace tack
