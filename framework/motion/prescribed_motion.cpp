#include "framework/motion/prescribed_motion.hpp"

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
void check_positions(const std::vector<int>& vertices, double t, const VecX& x) {
  constexpr double coordinate_max = 1e100;  // m
  for (const int v : vertices) {
    const Vec3 p = vertex(x, v);
    if (p.cwiseAbs().maxCoeff() <= coordinate_max && p.allFinite()) continue;
    throw SimulationError(fmt::format("puts vertex {} at ({:g}, {:g}, {:g}) m at t = {:.6g} s; it must be finite and at most "
                                      "{:g} m away", v, p.x(), p.y(), p.z(), t, coordinate_max));
  }
}

// Returns true if two motions of a vertex contradict each other: both fix all directions, or both fix
// directions that are not orthogonal. A motion that fixes all directions has precedence over one
// that fixes some.
bool contradict(const Motion& a, const Motion& b) {
  constexpr double round_off = 1e-9;
  if (a.partial() != b.partial()) return false;
  return !a.partial() || (a.fixed_directions() * b.fixed_directions()).norm() > round_off;
}

// Returns true if the spans cover all times from 0 on.
bool cover_all(std::vector<std::pair<double, double>> spans) {
  std::sort(spans.begin(), spans.end());
  double covered_until = 0;
  for (const auto& [from, until] : spans)
    if (from <= covered_until) covered_until = std::max(covered_until, until);
  return !std::isfinite(covered_until);
}

std::string end_of(double until) {
  return std::isfinite(until) ? fmt::format("{} s", until) : "the end";
}

}  // namespace

void PrescribedMotion::add_vertices(int added) {
  const size_t count = ever_free_.size() + static_cast<size_t>(added);
  ever_fixed_.resize(count, 0);
  ever_free_.resize(count, 1);
  moves_.resize(count, 0);
  rigid_group_.resize(count, -1);
}

void PrescribedMotion::add(Assignment assignment) {
  const Motion& motion = *assignment.motion;
  for (const Assignment& other : assignments_) {
    if (!at_the_same_time(motion, *other.motion) || !contradict(motion, *other.motion)) continue;
    std::vector<int> both;
    std::set_intersection(assignment.vertices.begin(), assignment.vertices.end(), other.vertices.begin(),
                          other.vertices.end(), std::back_inserter(both));
    if (both.empty()) continue;
    throw InputError(fmt::format("{} and {} fix {} vertices at once{}, from {} s to {}; give them different "
                                 "vertices (select) or times (from, until)", other.name, assignment.name, both.size(),
                                 motion.partial() ? " in directions that are not at right angles" : "",
                                 std::max(motion.from(), other.motion->from()),
                                 end_of(std::min(motion.until(), other.motion->until()))));
  }
  if (motion.partial()) {
    for (const int v : assignment.vertices) {
      ever_fixed_[v] = 1;
      if (motion.moves()) moves_[v] = 1;
    }
    assignments_.push_back(std::move(assignment));
    return;
  }
  const bool always = motion.from() <= 0 && !std::isfinite(motion.until());
  const int group = motion.moves() ? static_cast<int>(assignments_.size()) + 1 : 0;  // 0: vertices that do not move
  for (const int v : assignment.vertices) {
    ever_fixed_[v] = 1;
    if (always) {
      ever_free_[v] = 0;
    } else if (ever_free_[v]) {
      auto& spans = fixed_spans_[v];
      spans.emplace_back(motion.from(), motion.until());
      if (cover_all(spans)) ever_free_[v] = 0;
    }
    if (motion.moves()) moves_[v] = 1;
    if (always && motion.rigid()) rigid_group_[v] = group;
  }
  assignments_.push_back(std::move(assignment));
}

void PrescribedMotion::add_dependence(const Dependence& dependence) {
  const auto any = [&](const std::vector<char>& flags) {
    return std::any_of(dependence.on.begin(), dependence.on.end(), [&](const auto& on) { return flags[on.first] != 0; });
  };
  ever_free_[dependence.vertex] = any(ever_free_);
  moves_[dependence.vertex] = any(moves_);
}

std::vector<char> PrescribedMotion::active(double t) const {
  std::vector<char> active;
  for (const Assignment& assignment : assignments_) active.push_back(assignment.motion->from() <= t && t < assignment.motion->until());
  return active;
}

std::vector<char> PrescribedMotion::free(const std::vector<char>& active) const {
  std::vector<char> free(ever_free_.size(), 1);
  for (size_t i = 0; i < assignments_.size(); ++i)
    if (active[i] && !assignments_[i].motion->partial())
      for (const int v : assignments_[i].vertices) free[v] = 0;
  return free;
}

std::vector<FixedDirections> PrescribedMotion::fixed_directions(const std::vector<char>& active) const {
  const std::vector<char> free = this->free(active);
  std::map<int, Mat3> fixed;
  for (size_t i = 0; i < assignments_.size(); ++i)
    if (active[i] && assignments_[i].motion->partial())
      for (const int v : assignments_[i].vertices)
        if (free[v]) fixed.try_emplace(v, Mat3::Zero()).first->second += assignments_[i].motion->fixed_directions();
  std::vector<FixedDirections> all;
  for (const auto& [v, directions] : fixed) all.push_back({v, directions});
  for (const FixedDirections& always : always_fixed_)
    if (free[always.vertex]) all.push_back(always);
  return all;
}

void PrescribedMotion::set_positions(const std::vector<char>& active, const VecX& rest, const VecX& reference, double t,
                   VecX& x) const {
  for (const bool partial : {true, false})
    for (size_t i = 0; i < assignments_.size(); ++i)
      if (active[i] && assignments_[i].motion->partial() == partial) set_positions(assignments_[i], rest, reference, t, x);
}

void PrescribedMotion::set_positions(const Assignment& assignment, const VecX& rest, const VecX& reference, double t, VecX& x) {
  try {
    VecX before;
    if (assignment.motion->partial()) before = x;
    assignment.motion->set_positions(assignment.vertices, rest, reference, t, x);
    check_positions(assignment.vertices, t, x);
    if (!assignment.motion->partial()) return;
    const Mat3 fixed = assignment.motion->fixed_directions();
    for (const int v : assignment.vertices)
      vertex(x, v) = (vertex(before, v) + fixed * (vertex(x, v) - vertex(before, v))).eval();
  } catch (const SimulationError& error) {
    throw SimulationError(fmt::format("{}: {}", assignment.name, error.what()));
  }
}

}  // namespace tack
