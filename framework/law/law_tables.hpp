// Tables of a law as CSV text with a header line; numbers in SI that read back to equal bits.
#pragma once

#include <string>

#include "framework/law/bond_study.hpp"
#include "framework/law/gap_study.hpp"

namespace tack {

// Columns: gap, traction, energy, pair_traction, pair_energy; the last two with the barrier.
std::string curves_table(const GapStudy& study);
// Columns: path (slow, unloading, rate), angle [deg], speed (0: quasi-static), time, opening, slip,
// traction, shear, intensity, stored, dissipated.
std::string curves_table(const BondStudy& study);
// Columns: speed, peak, work; the first row is quasi-static, with the speed 0.
std::string rates_table(const BondStudy& study);
// Columns: pressure, time, strength.
std::string healing_table(const BondStudy& study);
// Columns: figure (name of the quantity), value, unit, remark.
std::string quantities_table(const std::vector<KeyQuantity>& quantities);

}  // namespace tack
