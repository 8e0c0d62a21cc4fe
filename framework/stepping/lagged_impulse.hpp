// Friction that lags by a step gives mu times every normal impulse, one step later.
//
// A force that is found at the end of a step is the impulse of that step over the time T for which it acts on velocities:
// h, but 2h/3 in a step of BDF2, whose velocities then go on by a = 1/3 of what they have gained:
//     p_n = a p_(n-1) + T N_n        the normal impulse of a step,    q_n = a q_(n-1) + T N'_n    friction's, over mu.
// In steps that are all alike N'_(n+1) = N_n gives q_(n+1) = p_n. Where the next step is of another size or of another
// integrator the same force is another impulse, so what is owed, the sum of all p less that of all q, is kept for each two
// objects:
//     q_(n+1) = (1 - s) p_n h_(n+1) / h_n + s owed,
// s = 0: a contact that lasts goes on with its force, whatever the size of steps; s = 1: one that comes or goes, with the
// impulse that is due. What has lasted for four times the next step, with a force that stayed within a quarter, is expected to
// last through it; what has for less than two is not. What there was when the run began has lasted for ever.
#pragma once

#include "framework/core/state.hpp"

namespace tack {

class FrictionTerm;

// Sets the normal forces that friction holds for the step of size h that has begun at the state, in which contact acts on
// velocities for `acting` [s]. Returns what has to be in the history once that step is kept.
HistoryArray carry_friction(FrictionTerm& friction, const State& state, double h, double acting);

// Not of any object: a scene that starts from another one's state owes nothing.
inline constexpr const char* owed_friction_name = "owed friction";

}  // namespace tack
