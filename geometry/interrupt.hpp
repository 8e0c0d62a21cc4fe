// Ctrl-C: the signal handler sets a flag. Minimisers and the time loop read it, so that a run ends
// between iterations with all results written. Mesh generation throws Interrupted.
#pragma once

#include <atomic>

namespace tack {

extern std::atomic<bool> interrupt_requested;

// Not a std::exception, so that it is not handled as an error.
struct Interrupted {};

}  // namespace tack
