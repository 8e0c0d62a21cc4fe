// Ctrl-C: the signal handler sets a flag, minimisers and the time loop look at it, so that a run ends
// between iterations with everything written.
#pragma once

#include <atomic>

namespace tack {

inline std::atomic<bool> interrupt_requested{false};

}  // namespace tack
