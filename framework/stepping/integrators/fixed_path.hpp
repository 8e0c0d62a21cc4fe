// Velocities and accelerations of vertices with prescribed motion, for integrators whose formulas
// would carry a jump of a prescribed velocity on from step to step: BDF2's, from positions alone.
#pragma once

#include <vector>

#include "framework/stepping/integrators/bdf2.hpp"

namespace tack {

class FixedPath {
 public:
  // Sets the velocities and accelerations (3n) of the vertices `fixed` at the end x of a stage.
  void update(const StepStage& stage, const VecX& x, const std::vector<int>& fixed, VecX& v,
              VecX& a) const {
    if (fixed.empty()) return;
    VecX v_path, a_path;
    bdf2_.update(stage, x, {}, v_path, a_path);
    for (const int i : fixed) {
      vertex(v, i) = vertex(v_path, i);
      vertex(a, i) = vertex(a_path, i);
    }
  }

 private:
  Bdf2 bdf2_;
};

}  // namespace tack
