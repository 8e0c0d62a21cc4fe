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

// A fixed vertex as a sum of frame vertices that are still undetermined, and of fixed vertices that
// determine others.
struct Row {
  int vertex;
  std::array<double, 4> on_frame;
  std::map<int, double> on_held = {};
};

// Solves the row for a vertex of the frame.
Dependence solved_for(const Row& row, int pivot, const std::array<int, 4>& frame) {
  const double w = row.on_frame[pivot];
  Dependence d{frame[pivot], {{row.vertex, 1 / w}}};
  for (int k = 0; k < 4; ++k)
    if (k != pivot && row.on_frame[k] != 0) d.on.emplace_back(frame[k], -row.on_frame[k] / w);
  for (const auto& [held, weight] : row.on_held) d.on.emplace_back(held, -weight / w);
  return d;
}

// Substitutes the pivot row's frame vertex in another row.
void substitute(const Row& by, int pivot, Row& row) {
  const double factor = row.on_frame[pivot] / by.on_frame[pivot];
  for (int k = 0; k < 4; ++k) row.on_frame[k] -= factor * by.on_frame[k];
  row.on_frame[pivot] = 0;
  row.on_held[by.vertex] += factor;
  for (const auto& [held, weight] : by.on_held) row.on_held[held] -= factor * weight;
}

// Returns the dependences of frame vertices on vertices of the body that are fixed or tied. leads:
// those of the latter that determine a frame vertex.
Dependences frame_follows(const AffineFrame& body, const std::set<int>& led, std::vector<int>& leads) {
  Dependences found;
  std::vector<Row> rows;
  for (const AffineFrame::Carried& c : body.carried)
    if (led.count(c.vertex)) rows.push_back({c.vertex, c.weights});
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
    leads.push_back(by.vertex);
    for (Row& row : rows) substitute(by, pivot, row);
  }
  return found;
}

}  // namespace

void MultiPointConstraints::carry(int first_of_frame, const AffineFrame::Carried& carried) {
  const auto at = std::find_if(frames_.begin(), frames_.end(), [&](const AffineFrame& f) { return f.frame[0] == first_of_frame; });
  at->carried.push_back(carried);
}

std::vector<char> MultiPointConstraints::active(double t) const {
  std::vector<char> active;
  for (const Tie& tie : ties_) active.push_back(tie.from <= t && t < tie.until);
  return active;
}

Dependences MultiPointConstraints::at(const std::vector<char>& free, const std::vector<char>& active_ties) const {
  Dependences all = unjoined_at(free, active_ties);
  if (joints_.empty()) return all;
  SolvedJoints solved = solve_joints(joints_, frames_, free, all);
  all.insert(all.end(), solved.dependences.begin(), solved.dependences.end());
  return all;
}

Dependences MultiPointConstraints::unjoined_at(const std::vector<char>& free, const std::vector<char>& active_ties) const {
  Dependences all = lasting_;
  std::set<int> led;
  for (int v = 0; v < static_cast<int>(free.size()); ++v)
    if (!free[v]) led.insert(v);
  for (size_t i = 0; i < ties_.size(); ++i)
    for (const Dependence& d : ties_[i].dependences)
      if (active_ties[i]) led.insert(d.vertex);
  for (const AffineFrame& body : frames_) {
    std::vector<int> leads;
    for (Dependence& d : frame_follows(body, led, leads)) all.push_back(std::move(d));
    for (const AffineFrame::Carried& c : body.carried) {
      if (std::find(leads.begin(), leads.end(), c.vertex) != leads.end()) continue;
      Dependence& d = all.emplace_back(Dependence{c.vertex, {}});
      for (int k = 0; k < 4; ++k)
        if (c.weights[k] != 0) d.on.emplace_back(body.frame[k], c.weights[k]);
    }
  }
  // Tied vertices of an affine body: only the leads stay tied; the others depend on the frame.
  std::set<int> following;
  for (const Dependence& d : all) following.insert(d.vertex);
  for (size_t i = 0; i < ties_.size(); ++i)
    for (const Dependence& d : ties_[i].dependences)
      if (active_ties[i] && !following.count(d.vertex)) all.push_back(d);
  return all;
}

}  // namespace tack
