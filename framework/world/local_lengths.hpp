// Length scale of each vertex: much smaller displacements neither invert elements nor close gaps.
#pragma once

#include "framework/world/world.hpp"

namespace tack {

// Returns, per vertex [m], the lesser of two lengths: the smallest altitude of its elements at rest
// (particles: radius; twists of rods: radius of gyration of the section), and the distance at x to
// objects that it may touch. A small fraction of it neither inverts an element nor closes a gap.
VecX local_lengths(const World& world, const VecX& x);

}  // namespace tack
