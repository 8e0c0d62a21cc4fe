// How far vertices may move without a change of what is inside or outside: the length scale of each.
#pragma once

#include "framework/world/world.hpp"

namespace tack {

// Per vertex [m]: the smallest altitude of its elements at rest (of particles their radius, of the twist of a rod the radius of
// gyration of its section) and distance to what it may touch at x, whichever is less. What moves a small part of it neither inverts an element nor closes a gap.
VecX local_lengths(const World& world, const VecX& x);

}  // namespace tack
