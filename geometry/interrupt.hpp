// Ctrl-C: the signal handler sets a flag, minimisers and the time loop look at it, so that a run
// ends between iterations with everything written. Mesh generation, which may take long before the
// run, throws Interrupted.
#pragma once

#include <atomic>

namespace tack {

extern std::atomic<bool> interrupt_requested;

// No std::exception, so that nobody takes it for an error.
struct Interrupted {};

}  // namespace tack
