// Plots of a law, by name:
//   traction, energy      over the gap, alone and with the barrier; over the opening, in each
//                         direction, with stored and dissipated energy
//   intensity             over the opening, for bonds with history variables
//   unloading, unloading_45, unloading_across   loading, unloading and reloading
//   rate                  quasi-static and at three speeds
//   peak_over_speed, work_over_speed   for laws that depend on the rate
//   healing               strength by the time of pressing
#pragma once

#include <map>
#include <string>

#include "framework/law/bond_study.hpp"
#include "framework/law/gap_study.hpp"
#include "framework/plot/plot.hpp"

namespace tack {

std::map<std::string, Plot> law_plots(const std::string& title, const GapStudy& study);
std::map<std::string, Plot> law_plots(const std::string& title, const BondStudy& study);

}  // namespace tack
