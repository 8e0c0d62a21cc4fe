// Tables of a law as CSV text with a header line; numbers in SI that read back to equal bits.
#pragma once

#include <string>

#include "framework/law/bond_study.hpp"
#include "framework/law/gap_study.hpp"

namespace tack {

// gap,traction,energy,pair_traction,pair_energy; the last two with the barrier.
std::string curves_table(const GapStudy& study);
// path (slow, unloading, rate),angle [deg],speed (0:
// slowly),time,opening,slip,traction,shear,intensity,stored,dissipated
std::string curves_table(const BondStudy& study);
// pressure,time,strength
std::string healing_table(const BondStudy& study);
// figure,value,unit,remark
std::string figures_table(const std::vector<LawFigure>& figures);

}  // namespace tack
