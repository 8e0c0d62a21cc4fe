// Continues a simulation with a changed scene: parameters, motions, loads, laws, protocols.
// Vertices and elements have to stay, and so do the numbers of motions and of stages.
#pragma once

#include "framework/run/simulation.hpp"

namespace tack {

// Returns the state of `before` as one from which `after`, a simulation of the changed scene that
// has not started, goes on:
// - Motions go on from where their vertices are: a translation with another velocity begins there.
// - Drives of protocols take up the changed action of their stage; under control and by formulas
//   they go on.
// - The energy account is opened again, so that what the change takes or adds is no numerical gain.
// Throws InputError if the scenes do not fit, or if a changed motion, such as a rotation, cannot go
// on from where its vertices are.
State changed_state(const Simulation& before, Simulation& after);

}  // namespace tack
