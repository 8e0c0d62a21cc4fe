// Short names of parallel loops for tables.
#pragma once

#include <string>

#include "geometry/source_position.hpp"

namespace tack {

// Returns the class and name of a function from its signature as compilers print it
// (SourcePosition::function_name), without return type, parameters and the namespace tack.
// Template parameters of the class are replaced by their values, which are left out if they are
// long. A body that is passed as a lambda names the function that made it: "for_each_part of
// IncompleteCholesky::apply".
std::string function_label(std::string signature);

// Returns function_label, file and line: "SolidTerm<NeoHookean>::value, solid_term.hpp:31".
std::string loop_label(const SourcePosition& loop);

}  // namespace tack
