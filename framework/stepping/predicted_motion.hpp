// The motion that starts the minimisation of a step: h v + h^2 a of its unknowns, as far as it
// takes no bond and no adhesion past the peak of its traction. Beyond the peak lies another minimum
// of the incremental potential, of surfaces apart. A minimiser that starts there stays there,
// however far the loads are from the strength. Two displacements that let go of nothing are tried,
// and the better one is taken:
// - an object of which something would let go is predicted without its acceleration, h v, as in
//   uniform motion; if that is too far as well, the object starts from its present position;
// - only the vertices of stencils that would let go start from their present positions: those ahead
//   of a crack, while the rest moves on.
#pragma once

#include <vector>

#include "framework/world/world.hpp"

namespace tack {

struct PredictedMotion {
  std::vector<VecX> ways;  // of the unknowns of the present step [m], none twice
  // Something lets go on every such way: the prescribed motion is the cause.
  bool lets_go = false;
};

// Returns the motion from x (3n). scripted: the prescribed displacement of vertices (3n); full:
// h v + h^2 a, drift: h v, both of the unknowns. All participants of the step are at x.
PredictedMotion predicted_motion(const World& world, const VecX& x, const VecX& scripted,
                                 const VecX& full, const VecX& drift);

// Returns whether a bond or an adhesion lets go between two configurations (3n). All participants
// of the step are at `from`.
bool anything_debonds(const World& world, const VecX& from, const VecX& to);

}  // namespace tack
