// Loads for which joined bodies are stiff enough.
#pragma once

#include <algorithm>
#include <limits>

#include "framework/affine/orthogonality_term.hpp"
#include "framework/world/world.hpp"

namespace tack {

// A moment [N m], or a force over the size of the body: the stress that strains the softer one by 1e-4, for which its stiffness was chosen,
// times its volume. other: -1 where there is none.
inline double joint_strength(const World& world, int object, int other) {
  double least = std::numeric_limits<double>::infinity();
  for (const int i : {object, other})
    if (i >= 0 && world.bodies[i].movable && !world.bodies[i].frame.empty())
      least = std::min(least, tolerated_affine_strain * world.bodies[i].stiffness * world.bodies[i].volume);
  return least;
}

}  // namespace tack
