// Which vertices are held in the present step, and from where their motions count.
// What a step that is rolled back seized or released is forgotten with it: anchors become those of
// the state when the step is committed.
#pragma once

#include <vector>

#include "framework/core/state.hpp"
#include "framework/scene/script.hpp"

namespace tack {

class HeldVertices {
 public:
  HeldVertices(const Script& script, const VecX& rest) : script_(script), rest_(rest) {}

  // Makes the holds at time `middle`, that of the step, the present ones; false if they are already.
  // Vertices that were not held in the step before are held where they are in the state.
  bool change(const State& state, double middle);
  void commit(State& state);

  const std::vector<char>& free() const { return free_; }      // per vertex
  const std::vector<int>& vertices() const { return held_; }  // ascending
  const std::vector<int>& released() const { return released_; }  // by the last change: free, and not before it
  // Whether some of the held vertices may be elsewhere at another time.
  bool may_move() const;
  // Writes where they are at time t into their rows of x.
  void place(double t, VecX& x) const { script_.place(active_, rest_, anchor_, t, x); }
  // Into how many equal parts the time from t to t + h has to be cut so that nothing that is moved rigidly
  // turns by more than a quarter in any: the straight ways of a half turn cross in the axis, those of a
  // quarter neither intersect nor invert what turns. A power of two, at most 64.
  int straight_parts(double t, double h) const;

 private:
  const Script& script_;
  const VecX& rest_;
  bool known_ = false;
  std::vector<char> active_;  // per hold of the script
  std::vector<char> free_;
  std::vector<int> held_, released_;
  VecX anchor_;  // 3n [m]
};

}  // namespace tack
