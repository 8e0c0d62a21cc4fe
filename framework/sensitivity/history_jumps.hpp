// Jumps between the histories of two scenes that differ by a small change of a parameter. A large
// difference of an entry means that a discrete event (a new bond, a switched side) has happened in
// one scene only; the difference of the scenes is then no derivative.
#pragma once

#include "framework/core/history.hpp"

namespace tack {

// Replaces entries of `other` that differ much from those of `run` by the run's; returns their
// number.
int replace_jumps(const History& run, History& other);

}  // namespace tack
