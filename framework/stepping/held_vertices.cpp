#include "framework/stepping/held_vertices.hpp"

#include <algorithm>

namespace tack {

bool HeldVertices::change(const State& state, double middle) {
  std::vector<char> active = script_.active(middle);
  if (known_ && active == active_) return false;
  std::vector<char> free_before(script_.vertex_count(), 0);  // before the first step, nothing has a past
  if (known_) free_before = free_;
  else if (state.step > 0) free_before = script_.free(state.held);
  known_ = true;
  active_ = std::move(active);
  free_ = script_.free(active_);
  held_.clear();
  released_.clear();
  for (int v = 0; v < static_cast<int>(free_.size()); ++v) {
    if (!free_[v]) held_.push_back(v);
    if (free_[v] && !free_before[v]) released_.push_back(v);
  }
  anchor_ = state.anchor.size() > 0 ? state.anchor : state.x;
  for (size_t i = 0; i < active_.size(); ++i)
    if (active_[i] && !(i < state.held.size() && state.held[i]))
      for (const int v : script_.holds()[i].vertices) vertex(anchor_, v) = vertex(state.x, v);
  return true;
}

void HeldVertices::commit(State& state) {
  if (active_ == state.held && state.anchor.size() > 0) return;
  state.held = active_;
  state.anchor = anchor_;
}

bool HeldVertices::may_move() const {
  return std::any_of(held_.begin(), held_.end(), [&](int v) { return script_.may_move(v); });
}

}  // namespace tack
