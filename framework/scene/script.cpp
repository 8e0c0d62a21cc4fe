#include "framework/scene/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/errors.hpp"

namespace tack {
namespace {

bool at_the_same_time(const Motion& a, const Motion& b) {
  return a.from() < b.until() && b.from() < a.until();
}

// The squares of distances have to remain numbers.
void check_places(const std::vector<int>& vertices, double t, const VecX& x) {
  constexpr double furthest = 1e100;  // m
  for (const int v : vertices) {
    const Vec3 p = vertex(x, v);
    if (p.cwiseAbs().maxCoeff() <= furthest && p.allFinite()) continue;
    throw SimulationError(fmt::format("puts vertex {} at ({:g}, {:g}, {:g}) m at t = {} s; it must be finite and at most "
                                      "{:g} m away", v, p.x(), p.y(), p.z(), t, furthest));
  }
}

std::string end_of(double until) {
  return std::isfinite(until) ? fmt::format("{} s", until) : "the end";
}

}  // namespace

void Script::add(Hold hold) {
  const Motion& motion = *hold.motion;
  for (const Hold& other : holds_) {
    if (!at_the_same_time(motion, *other.motion)) continue;
    std::vector<int> both;
    std::set_intersection(hold.vertices.begin(), hold.vertices.end(), other.vertices.begin(),
                          other.vertices.end(), std::back_inserter(both));
    if (both.empty()) continue;
    throw InputError(fmt::format("{} and {} hold {} vertices at once, from {} s to {}; give them different "
                                 "vertices (select) or times (from, until)", other.name, hold.name, both.size(),
                                 std::max(motion.from(), other.motion->from()),
                                 end_of(std::min(motion.until(), other.motion->until()))));
  }
  const bool always = motion.from() <= 0 && !std::isfinite(motion.until());
  const int group = motion.moves() ? static_cast<int>(holds_.size()) + 1 : 0;  // all that is fixed: 0
  for (const int v : hold.vertices) {
    ever_held_[v] = 1;
    if (always) ever_free_[v] = 0;
    if (motion.moves()) moves_[v] = 1;
    if (always && motion.rigid()) rigid_group_[v] = group;
  }
  holds_.push_back(std::move(hold));
}

std::vector<char> Script::active(double t) const {
  std::vector<char> active;
  for (const Hold& hold : holds_) active.push_back(hold.motion->from() <= t && t < hold.motion->until());
  return active;
}

std::vector<char> Script::free(const std::vector<char>& active) const {
  std::vector<char> free(ever_free_.size(), 1);
  for (size_t i = 0; i < holds_.size(); ++i)
    if (active[i])
      for (const int v : holds_[i].vertices) free[v] = 0;
  return free;
}

void Script::place(const std::vector<char>& active, const VecX& rest, const VecX& anchor, double t,
                   VecX& x) const {
  for (size_t i = 0; i < holds_.size(); ++i) {
    if (!active[i]) continue;
    try {
      holds_[i].motion->place(holds_[i].vertices, rest, anchor, t, x);
      check_places(holds_[i].vertices, t, x);
    } catch (const SimulationError& error) {
      throw SimulationError(fmt::format("{}: {}", holds_[i].name, error.what()));
    }
  }
}

}  // namespace tack
