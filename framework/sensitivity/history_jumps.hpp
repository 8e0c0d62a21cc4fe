// What is remembered in two scenes that hardly differ: where it is not nearly the same, something has happened in one of them that has not
// in the other (a bond was made, a side was changed), and no difference of theirs is a derivative.
#pragma once

#include "framework/core/history.hpp"

namespace tack {

// Entries of `other` that are not nearly those of `run` become those; how many.
int take_jumps_from(const History& run, History& other);

}  // namespace tack
