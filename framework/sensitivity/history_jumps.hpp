// Jumps between the histories of two scenes that differ by a small number. Where an entry differs
// much, a discrete event (a new bond, a changed side) has happened in one scene only, and the
// difference of the scenes is no derivative.
#pragma once

#include "framework/core/history.hpp"

namespace tack {

// Replaces entries of `other` that differ much from those of `run` by the run's; returns their
// number.
int take_jumps_from(const History& run, History& other);

}  // namespace tack
