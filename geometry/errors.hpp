// Exceptions that cross layers. Each message names what is wrong, where, and what to do about it.
#pragma once

#include <stdexcept>
#include <string>

namespace tack {

// Bad input: a scene file, a mesh, a parameter, a start that intersects. The program exits with 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A simulation that cannot go on: no step small enough converges. The program exits with 3.
struct SimulationError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace tack
