// Ctrl-C: the signal handler sets a flag. Minimisers and the time loop read it, so that a run ends
// between iterations with all results written. Mesh generation throws Interrupted.
#pragma once

#include <atomic>
#include <string_view>

namespace tack {

extern std::atomic<bool> interrupt_requested;

// Not a std::exception, so that it is not handled as an error.
struct Interrupted {
  // When it came, and what was not done; a literal.
  std::string_view remark = "while meshes were made; no step was done, nothing is written";
};

}  // namespace tack
