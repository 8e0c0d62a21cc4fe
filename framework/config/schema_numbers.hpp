// Patterns of the JSON schema for numbers of a unit: "5", "5 MPa", "1e-3 N/mm^2".
// Limit: a pattern cannot parse units or compute dimensions. The patterns check common units with
// prefixes: alone, to a power, and products or quotients of two. Other spellings ("kg m-1 s-2",
// "furlong") pass, and the program checks them.
#pragma once

#include <string>
#include <vector>

#include "framework/config/units.hpp"

namespace tack {

// Matches any number, with or without a unit.
extern const char* const number_pattern;
// Matches possible expressions of parameters (parameters.hpp): texts that begin with a name or have
// an operator.
extern const char* const expression_pattern;

// known_unit_pattern: matches numbers in the common units, of any dimension. unit_pattern: matches
// those of them that `unit` accepts.
std::string known_unit_pattern();
std::string unit_pattern(const Unit& unit);

}  // namespace tack
