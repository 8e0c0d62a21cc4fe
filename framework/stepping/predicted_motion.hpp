// Predicted motion, the start of the minimisation of a step: h v + h^2 a of its unknowns, if it
// takes no bond and no adhesion past the peak of its traction. Beyond the peak the incremental
// potential has another minimum, of separated surfaces. A minimiser that starts there stays there,
// however far the loads are below the strength. If the prediction would debond stencils, two
// displacements without debonding are tried, and the one of lower potential is used:
// - by objects: an object with such a stencil moves uniformly, by h v; if that debonds as well, it
//   starts from its present position;
// - by vertices: only the vertices of such stencils start from their present positions, e.g. those
//   at the tip of a crack.
#pragma once

#include <vector>

#include "framework/world/world.hpp"

namespace tack {

struct PredictedMotion {
  // Displacements to try, of the unknowns of the present step [m], without duplicates.
  std::vector<VecX> displacements;
  // True if stencils debond under every displacement: the prescribed motion is the cause.
  bool debonds = false;
};

// Returns the motion from x (3n). prescribed: prescribed displacement of vertices (3n); full:
// h v + h^2 a; uniform: h v, both of the unknowns. All participants of the step must be at x.
PredictedMotion predicted_motion(const World& world, const VecX& x, const VecX& prescribed,
                                 const VecX& full, const VecX& uniform);

// Returns whether a bond or an adhesion passes the peak of its traction between two configurations
// (3n). All participants of the step must be at `from`.
bool anything_debonds(const World& world, const VecX& from, const VecX& to);

}  // namespace tack
