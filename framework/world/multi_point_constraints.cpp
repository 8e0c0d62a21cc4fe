#include "framework/world/multi_point_constraints.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "framework/world/joint_relations.hpp"

namespace tack {
namespace {

// Weight on the rest of a frame above which a fixed vertex is an independent position.
constexpr double independent = 1e-6;

// Fixed vertex as a weighted sum of undetermined frame vertices and of fixed vertices that determine
// the other frame vertices.
struct Row {
  int vertex;
  std::array<double, 4> on_frame;
  std::map<int, double> on_fixed = {};
};

// Solves the row for a vertex of the frame.
Dependence solved_for(const Row& row, int pivot, const std::array<int, 4>& frame) {
  const double w = row.on_frame[pivot];
  Dependence d{frame[pivot], {{row.vertex, 1 / w}}};
  for (int k = 0; k < 4; ++k)
    if (k != pivot && row.on_frame[k] != 0) d.on.emplace_back(frame[k], -row.on_frame[k] / w);
  for (const auto& [fixed, weight] : row.on_fixed) d.on.emplace_back(fixed, -weight / w);
  return d;
}

// Substitutes the pivot row's frame vertex in another row.
void substitute(const Row& by, int pivot, Row& row) {
  const double factor = row.on_frame[pivot] / by.on_frame[pivot];
  for (int k = 0; k < 4; ++k) row.on_frame[k] -= factor * by.on_frame[k];
  row.on_frame[pivot] = 0;
  row.on_fixed[by.vertex] += factor;
  for (const auto& [fixed, weight] : by.on_fixed) row.on_fixed[fixed] -= factor * weight;
}

// Returns the dependences of frame vertices on the determined vertices of the body: those fixed or
// dependent on another object. determining: the determined vertices that were used.
Dependences frame_dependences(const AffineFrame& body, const std::set<int>& determined, std::vector<int>& determining) {
  Dependences found;
  std::vector<Row> rows;
  for (const AffineFrame::Dependent& c : body.dependents)
    if (determined.count(c.vertex)) rows.push_back({c.vertex, c.weights});
  while (!rows.empty() && found.size() < 4) {
    size_t best = 0;
    int pivot = 0;
    for (size_t r = 0; r < rows.size(); ++r)
      for (int k = 0; k < 4; ++k)
        if (std::abs(rows[r].on_frame[k]) > std::abs(rows[best].on_frame[pivot])) best = r, pivot = k;
    if (std::abs(rows[best].on_frame[pivot]) < independent) break;
    const Row by = rows[best];
    rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(best));
    found.push_back(solved_for(by, pivot, body.frame));
    determining.push_back(by.vertex);
    for (Row& row : rows) substitute(by, pivot, row);
  }
  return found;
}

}  // namespace

void MultiPointConstraints::add_dependent(int first_of_frame, const AffineFrame::Dependent& dependent) {
  const auto at = std::find_if(frames_.begin(), frames_.end(), [&](const AffineFrame& f) { return f.frame[0] == first_of_frame; });
  at->dependents.push_back(dependent);
}

std::vector<char> MultiPointConstraints::active(double t) const {
  std::vector<char> active;
  for (const TimedConstraint& timed : timed_) active.push_back(timed.from <= t && t < timed.until);
  return active;
}

Dependences MultiPointConstraints::at(const std::vector<char>& free, const std::vector<char>& active_timed) const {
  Dependences all = unjoined_at(free, active_timed);
  if (joints_.empty()) return all;
  SolvedJoints solved = solve_joints(joints_, frames_, free, all);
  all.insert(all.end(), solved.dependences.begin(), solved.dependences.end());
  return all;
}

Dependences MultiPointConstraints::unjoined_at(const std::vector<char>& free, const std::vector<char>& active_timed) const {
  Dependences all = lasting_;
  std::set<int> determined;
  for (int v = 0; v < static_cast<int>(free.size()); ++v)
    if (!free[v]) determined.insert(v);
  for (size_t i = 0; i < timed_.size(); ++i)
    for (const Dependence& d : timed_[i].dependences)
      if (active_timed[i]) determined.insert(d.vertex);
  for (const AffineFrame& body : frames_) {
    std::vector<int> determining;
    for (Dependence& d : frame_dependences(body, determined, determining)) all.push_back(std::move(d));
    for (const AffineFrame::Dependent& c : body.dependents) {
      if (std::find(determining.begin(), determining.end(), c.vertex) != determining.end()) continue;
      Dependence& d = all.emplace_back(Dependence{c.vertex, {}});
      for (int k = 0; k < 4; ++k)
        if (c.weights[k] != 0) d.on.emplace_back(body.frame[k], c.weights[k]);
    }
  }
  // Determining vertices of an affine body stay dependent on the other object; its other vertices
  // depend on the frame.
  std::set<int> dependent;
  for (const Dependence& d : all) dependent.insert(d.vertex);
  for (size_t i = 0; i < timed_.size(); ++i)
    for (const Dependence& d : timed_[i].dependences)
      if (active_timed[i] && !dependent.count(d.vertex)) all.push_back(d);
  return all;
}

}  // namespace tack
