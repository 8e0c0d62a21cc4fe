#include "framework/stepping/held_vertices.hpp"

#include <algorithm>

namespace tack {
namespace {

Vec3 centre(const VecX& x, const std::vector<int>& vertices) {
  Vec3 sum = Vec3::Zero();
  for (const int v : vertices) sum += vertex(x, v);
  return sum / static_cast<double>(vertices.size());
}

// Whether the vertices, which keep their distances, turn further: half way between a and b a body that turns
// by an angle w is as wide as cos(w/2) across the axis.
bool more_than_a_quarter(const std::vector<int>& vertices, const VecX& a, const VecX& b) {
  constexpr double narrow = 0.7;
  const Vec3 centre_a = centre(a, vertices), centre_b = centre(b, vertices);
  return std::any_of(vertices.begin(), vertices.end(), [&](int v) {
    const Vec3 from_a = vertex(a, v) - centre_a, from_b = vertex(b, v) - centre_b;
    return (from_a + from_b).norm() / 2 < narrow * from_a.norm();
  });
}

}  // namespace

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

int HeldVertices::straight_parts(double t, double h) const {
  constexpr int most = 64;
  const auto turns = [&](double from, double until) {
    VecX start = rest_, end = rest_;
    place(from, start);
    place(until, end);
    for (size_t i = 0; i < active_.size(); ++i) {
      const Script::Hold& hold = script_.holds()[i];
      const bool turning = active_[i] && hold.motion->moves() && hold.motion->rigid();
      if (turning && more_than_a_quarter(hold.vertices, start, end)) return true;
    }
    return false;
  };
  int parts = 1;
  for (int i = 0; i < parts && parts < most; ++i)
    if (turns(t + h * i / parts, t + h * (i + 1) / parts)) parts *= 2, i = -1;
  return parts;
}

bool HeldVertices::may_move() const {
  return std::any_of(held_.begin(), held_.end(), [&](int v) { return script_.may_move(v); });
}

}  // namespace tack
