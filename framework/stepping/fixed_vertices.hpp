// Fixed vertices of the present step, the origins of their motions, and dependent vertices. A step
// that is rolled back changes none of them: anchors become those of the state at commit.
#pragma once

#include <vector>

#include "framework/core/dof_map.hpp"
#include "framework/core/state.hpp"
#include "framework/motion/prescribed_motion.hpp"
#include "framework/world/multi_point_constraints.hpp"

namespace tack {

class FixedVertices {
 public:
  FixedVertices(const PrescribedMotion& prescribed_motion, const MultiPointConstraints& constraints, const VecX& rest)
      : prescribed_motion_(prescribed_motion), constraints_(constraints), rest_(rest) {}

  // Activates the holds and ties at `middle`, the middle of the step; returns false if they were
  // active already. Vertices that become fixed stay at their positions in the state.
  bool change(const State& state, double middle);
  void commit(State& state);

  const DofMap& dofs() const { return dofs_; }
  std::vector<char> moving() const;  // per vertex: whether unknowns move it
  const std::vector<int>& vertices() const { return held_; }  // that none moves, ascending
  // By the last change: that have unknowns of their own, and none moved them before it.
  const std::vector<int>& released() const { return released_; }
  // Returns whether some of the held vertices may be elsewhere at another time.
  bool may_move() const;
  // Writes the positions of the held vertices at time t, and of those that depend on them, into x
  // (3n). Throws SimulationError if an affine body would have to deform otherwise than affinely.
  void place(double t, VecX& x) const;
  // Returns the number of equal substeps from t to t + h in which no rigid motion turns by more
  // than a quarter: the linear trajectories of a half turn cross in the axis, those of a quarter
  // neither intersect nor invert the body. A power of two, at most 64.
  int straight_parts(double t, double h) const;

 private:
  DofMap dofs_of(const std::vector<char>& active) const;

  const PrescribedMotion& prescribed_motion_;
  const MultiPointConstraints& constraints_;
  const VecX& rest_;
  bool known_ = false;
  std::vector<char> active_;  // per hold of the script, then per tie
  DofMap dofs_;
  std::vector<int> held_, released_;
  VecX anchor_;  // 3n [m]
};

}  // namespace tack
