// Units of temperature and of energy per amount of substance (units.hpp).
#pragma once

#include "framework/config/units.hpp"

namespace tack::units {

inline constexpr Unit temperature{"K", "temperature"};  // "20 degC" is 293.15 K
inline constexpr Unit temperature_difference{"K", "temperature difference"};  // no degC
inline constexpr Unit molar_energy{"J/mol", "energy per amount"};

}  // namespace tack::units
