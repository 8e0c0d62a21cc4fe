// Configurations of infinite energy: elements or joints beyond a limit (LimitView), or in a state
// that their energy excludes.
#pragma once

#include <string>

#include "framework/world/world.hpp"

namespace tack {

/// Says why a lasting term is infinite at x (3n): with the element, its strain and the limit if the
/// term knows them, "triangle (1, 2, 5) of 'strip' would have the principal strain 0.101, and
/// strain_limit allows less than 0.1 (`strain`)". Returns "" if the term is finite.
std::string describe_infinite_energy(const World& world, const Term& term, const VecX& x);

/// Says so of the first such term of the world. Returns "" if all energies are finite.
std::string describe_infinite_energy(const World& world, const VecX& x);

}  // namespace tack
