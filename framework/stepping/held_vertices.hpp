// Which vertices are held in the present step, and from where their motions count; and which follow others.
// What a step that is rolled back seized or released is forgotten with it: anchors become those of
// the state when the step is committed.
#pragma once

#include <vector>

#include "framework/core/dof_map.hpp"
#include "framework/core/state.hpp"
#include "framework/motion/script.hpp"
#include "framework/world/multi_point_constraints.hpp"

namespace tack {

class HeldVertices {
 public:
  HeldVertices(const Script& script, const MultiPointConstraints& bindings, const VecX& rest)
      : script_(script), bindings_(bindings), rest_(rest) {}

  // Makes the holds and ties at time `middle`, that of the step, the present ones; false if they are already.
  // Vertices that were not held in the step before are held where they are in the state.
  bool change(const State& state, double middle);
  void commit(State& state);

  const DofMap& dofs() const { return dofs_; }
  std::vector<char> moving() const;  // per vertex: whether unknowns move it
  const std::vector<int>& vertices() const { return held_; }  // that none moves, ascending
  // By the last change: that have unknowns of their own, and none moved them before it.
  const std::vector<int>& released() const { return released_; }
  // Whether some of the held vertices may be elsewhere at another time.
  bool may_move() const;
  // Writes where they are at time t into their rows of x; what depends on them follows. Throws SimulationError if an
  // affine body would have to deform otherwise.
  void place(double t, VecX& x) const;
  // Into how many equal parts the time from t to t + h has to be cut so that nothing that is moved rigidly
  // turns by more than a quarter in any: the straight ways of a half turn cross in the axis, those of a
  // quarter neither intersect nor invert what turns. A power of two, at most 64.
  int straight_parts(double t, double h) const;

 private:
  DofMap dofs_of(const std::vector<char>& active) const;

  const Script& script_;
  const MultiPointConstraints& bindings_;
  const VecX& rest_;
  bool known_ = false;
  std::vector<char> active_;  // per hold of the script, then per tie
  DofMap dofs_;
  std::vector<int> held_, released_;
  VecX anchor_;  // 3n [m]
};

}  // namespace tack
