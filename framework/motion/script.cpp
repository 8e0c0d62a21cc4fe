#include "framework/motion/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/errors.hpp"

namespace tack {
namespace {

bool at_the_same_time(const Motion& a, const Motion& b) {
  return a.from() < b.until() && b.from() < a.until();
}

// Throws SimulationError for positions that are not finite or whose squared distances may overflow.
void check_places(const std::vector<int>& vertices, double t, const VecX& x) {
  constexpr double furthest = 1e100;  // m
  for (const int v : vertices) {
    const Vec3 p = vertex(x, v);
    if (p.cwiseAbs().maxCoeff() <= furthest && p.allFinite()) continue;
    throw SimulationError(fmt::format("puts vertex {} at ({:g}, {:g}, {:g}) m at t = {} s; it must be finite and at most "
                                      "{:g} m away", v, p.x(), p.y(), p.z(), t, furthest));
  }
}

// Returns true if two motions of a vertex contradict each other: both fix all directions, or both fix some that are not
// orthogonal. A motion of all directions has precedence over one of some directions.
bool contradict(const Motion& a, const Motion& b) {
  constexpr double round_off = 1e-9;
  if (a.partial() != b.partial()) return false;
  return !a.partial() || (a.held_directions() * b.held_directions()).norm() > round_off;
}

// Returns true if the spans cover all times from 0 on.
bool cover_all(std::vector<std::pair<double, double>> spans) {
  std::sort(spans.begin(), spans.end());
  double reach = 0;
  for (const auto& [from, until] : spans)
    if (from <= reach) reach = std::max(reach, until);
  return !std::isfinite(reach);
}

std::string end_of(double until) {
  return std::isfinite(until) ? fmt::format("{} s", until) : "the end";
}

}  // namespace

void Script::grow(int more) {
  const size_t count = ever_free_.size() + static_cast<size_t>(more);
  ever_held_.resize(count, 0);
  ever_free_.resize(count, 1);
  moves_.resize(count, 0);
  rigid_group_.resize(count, -1);
}

void Script::add(Hold hold) {
  const Motion& motion = *hold.motion;
  for (const Hold& other : holds_) {
    if (!at_the_same_time(motion, *other.motion) || !contradict(motion, *other.motion)) continue;
    std::vector<int> both;
    std::set_intersection(hold.vertices.begin(), hold.vertices.end(), other.vertices.begin(),
                          other.vertices.end(), std::back_inserter(both));
    if (both.empty()) continue;
    throw InputError(fmt::format("{} and {} hold {} vertices at once{}, from {} s to {}; give them different "
                                 "vertices (select) or times (from, until)", other.name, hold.name, both.size(),
                                 motion.partial() ? " in directions that are not at right angles" : "",
                                 std::max(motion.from(), other.motion->from()),
                                 end_of(std::min(motion.until(), other.motion->until()))));
  }
  if (motion.partial()) {
    for (const int v : hold.vertices) {
      ever_held_[v] = 1;
      if (motion.moves()) moves_[v] = 1;
    }
    holds_.push_back(std::move(hold));
    return;
  }
  const bool always = motion.from() <= 0 && !std::isfinite(motion.until());
  const int group = motion.moves() ? static_cast<int>(holds_.size()) + 1 : 0;  // all that is fixed: 0
  for (const int v : hold.vertices) {
    ever_held_[v] = 1;
    if (always) {
      ever_free_[v] = 0;
    } else if (ever_free_[v]) {
      auto& spans = held_spans_[v];
      spans.emplace_back(motion.from(), motion.until());
      if (cover_all(spans)) ever_free_[v] = 0;
    }
    if (motion.moves()) moves_[v] = 1;
    if (always && motion.rigid()) rigid_group_[v] = group;
  }
  holds_.push_back(std::move(hold));
}

void Script::follow(const Dependence& dependence) {
  const auto any = [&](const std::vector<char>& flags) {
    return std::any_of(dependence.on.begin(), dependence.on.end(), [&](const auto& on) { return flags[on.first] != 0; });
  };
  ever_free_[dependence.vertex] = any(ever_free_);
  moves_[dependence.vertex] = any(moves_);
}

std::vector<char> Script::active(double t) const {
  std::vector<char> active;
  for (const Hold& hold : holds_) active.push_back(hold.motion->from() <= t && t < hold.motion->until());
  return active;
}

std::vector<char> Script::free(const std::vector<char>& active) const {
  std::vector<char> free(ever_free_.size(), 1);
  for (size_t i = 0; i < holds_.size(); ++i)
    if (active[i] && !holds_[i].motion->partial())
      for (const int v : holds_[i].vertices) free[v] = 0;
  return free;
}

std::vector<HeldDirections> Script::held_directions(const std::vector<char>& active) const {
  const std::vector<char> free = this->free(active);
  std::map<int, Mat3> held;
  for (size_t i = 0; i < holds_.size(); ++i)
    if (active[i] && holds_[i].motion->partial())
      for (const int v : holds_[i].vertices)
        if (free[v]) held.try_emplace(v, Mat3::Zero()).first->second += holds_[i].motion->held_directions();
  std::vector<HeldDirections> all;
  for (const auto& [v, directions] : held) all.push_back({v, directions});
  for (const HeldDirections& always : always_held_)
    if (free[always.vertex]) all.push_back(always);
  return all;
}

void Script::place(const std::vector<char>& active, const VecX& rest, const VecX& anchor, double t,
                   VecX& x) const {
  for (const bool partial : {true, false})
    for (size_t i = 0; i < holds_.size(); ++i)
      if (active[i] && holds_[i].motion->partial() == partial) place(holds_[i], rest, anchor, t, x);
}

void Script::place(const Hold& hold, const VecX& rest, const VecX& anchor, double t, VecX& x) {
  try {
    VecX before;
    if (hold.motion->partial()) before = x;
    hold.motion->place(hold.vertices, rest, anchor, t, x);
    check_places(hold.vertices, t, x);
    if (!hold.motion->partial()) return;
    const Mat3 held = hold.motion->held_directions();
    for (const int v : hold.vertices)
      vertex(x, v) = (vertex(before, v) + held * (vertex(x, v) - vertex(before, v))).eval();
  } catch (const SimulationError& error) {
    throw SimulationError(fmt::format("{}: {}", hold.name, error.what()));
  }
}

}  // namespace tack
