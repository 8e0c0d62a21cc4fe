// Ends of stages of a protocol: their errors, and what messages and records say of them.
#pragma once

#include <string>

#include "framework/protocol/protocol_config.hpp"

namespace tack {

inline constexpr double value_error = 1e-3;     // of the limit or target of a probe
inline constexpr double contact_error = 1e-2;   // of the contact distance, for first contact
inline constexpr double time_tolerance = 1e-3;  // of time.step

std::string with_unit(double value, const Unit& unit);

// Returns what ends a stage: "force above 0.5 N". unit: of its probe.
std::string text_of(const EndCondition& end, const Unit& unit);

}  // namespace tack
