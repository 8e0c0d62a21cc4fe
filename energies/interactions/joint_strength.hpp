// Default strength of joints, from the stiffness of the joined bodies.
#pragma once

#include <algorithm>
#include <limits>

#include "framework/affine/orthogonality_term.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Returns a moment [N m], or a force times the size of the body: the stress that strains the softer
// body by 1e-4 (the strain for which its stiffness was chosen), times its volume. other: -1 for
// none.
inline double joint_strength(const World& world, int object, int other) {
  double least = std::numeric_limits<double>::infinity();
  for (const int i : {object, other})
    if (i >= 0 && world.bodies[i].movable && !world.bodies[i].frame.empty())
      least = std::min(
          least, tolerated_affine_strain * world.bodies[i].stiffness * world.bodies[i].volume);
  return least;
}

}  // namespace tack
