#include "framework/load/following_load.hpp"

namespace tack {

void FollowingLoad::begin_step(const StepStart& start) {
  start_ = start.x;
  time_ = start.time;
  h_ = start.h;
  if (needs_velocities() && start.before && start.velocity) {
    before_ = *start.before;
    after_ = *start.velocity;
  } else {
    before_ = VecX::Zero(start.x.size());
    after_ = {0, start.x};
  }
}

double FollowingLoad::work_of(const VecX& forces, const VecX& displacement, const DofMap& dofs) {
  double work = 0;
  for (int v = 0; v < dofs.vertex_count(); ++v)
    if (dofs.moves(v)) work += vertex(forces, v).dot(vertex(displacement, v));
  return work;
}

double FollowingLoad::work(const VecX& x, const DofMap& dofs) const {
  const VecX displacement = x - start_;
  VecX sum = VecX::Zero(x.size()), middle = sum;
  add_forces(start_, 0, sum);
  add_forces(start_ + displacement / 2, 0.5, middle);
  sum += 4 * middle;
  add_forces(x, 1, sum);
  return work_of(sum / 6, displacement, dofs);
}

}  // namespace tack
