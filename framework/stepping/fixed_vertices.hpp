// Fixed vertices of the present step, the reference positions of their motions, and dependent
// vertices. The state gets them at commit, so that a rejected step leaves it unchanged.
#pragma once

#include <vector>

#include "framework/core/dof_map.hpp"
#include "framework/core/state.hpp"
#include "framework/motion/prescribed_motion.hpp"
#include "framework/world/multi_point_constraints.hpp"

namespace tack {

class FixedVertices {
 public:
  FixedVertices(const PrescribedMotion& prescribed_motion, const MultiPointConstraints& constraints,
                const VecX& rest)
      : prescribed_motion_(prescribed_motion), constraints_(constraints), rest_(rest) {}

  // Activates the motions and timed constraints at `middle`, the middle of the step [s]. Returns
  // false if nothing changed. Vertices that become fixed keep their positions in the state.
  bool activate(const State& state, double middle);
  void commit(State& state);

  const DofMap& dofs() const { return dofs_; }
  // Returns a flag per vertex: whether unknowns move it.
  std::vector<char> moving() const;
  // Returns the vertices that no unknown moves, ascending.
  const std::vector<int>& vertices() const { return fixed_; }
  // Returns the vertices that the last change released: they have unknowns of their own now, and no
  // unknown moved them before.
  const std::vector<int>& released() const { return released_; }
  // Returns whether a prescribed motion may ever move some of the fixed vertices.
  bool may_move() const;
  // Writes the positions at time t [s] of the fixed vertices, and of vertices that depend on them,
  // into x (3n). Throws SimulationError if an affine body would not deform affinely, or a joint
  // would be torn.
  void set_positions(double t, VecX& x) const;
  // Returns the number of equal substeps from t to t + h in each of which no rigid motion rotates
  // by more than a quarter turn: a power of two, at most 64. The linear trajectories of a half turn
  // cross at the axis; those of a quarter turn neither intersect nor invert the body.
  int rotation_substeps(double t, double h) const;

 private:
  DofMap dofs_of(const std::vector<char>& active) const;

  const PrescribedMotion& prescribed_motion_;
  const MultiPointConstraints& constraints_;
  const VecX& rest_;
  bool known_ = false;
  std::vector<char> active_;  // per motion, then per timed constraint
  DofMap dofs_;
  std::vector<int> fixed_, released_;
  VecX x_motion_start_;  // 3n: reference positions of the motions [m]
};

}  // namespace tack
