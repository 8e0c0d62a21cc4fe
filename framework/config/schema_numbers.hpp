// The texts that the JSON schema accepts for a number of a unit: "5", "5 MPa", "1e-3 N/mm^2".
//
// A pattern can neither parse units nor work out dimensions. So it knows the common units with their prefixes, alone, to a power, and two
// of them multiplied or divided: those have to be of the right kind. What is written in any other way ("kg m-1 s-2", "furlong") is left to
// the program.
#pragma once

#include <string>
#include <vector>

#include "framework/config/units.hpp"

namespace tack {

// Any number, with or without a unit.
extern const char* const number_pattern;
// What may be an expression of parameters (parameters.hpp): it begins with a name, or has an operator.
extern const char* const expression_pattern;

// Numbers in units that are known here, of any kind; and those of them that `unit` accepts.
std::string known_unit_pattern();
std::string unit_pattern(const Unit& unit);

}  // namespace tack
