// Comparison of states to the bit.
#pragma once

#include <string>

#include "framework/core/state.hpp"

namespace tack {

// Returns the first part of two states that differs, with the largest difference, or "".
std::string first_difference(const State& a, const State& b);

}  // namespace tack
