#include "framework/world/joint_relations.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "framework/core/independent_vertices.hpp"

namespace tack {
namespace {

constexpr double determining_weight_min = 1e-6;  // smallest weight at which a relation determines a vertex
constexpr double round_off = 1e-12;

using Weights = std::map<int, double>;

struct Entry {
  size_t row = 0;
  int vertex = -1;
  double weight = 0;
};

Entry largest(const std::vector<Weights>& rows, const std::set<int>& among) {
  Entry best;
  for (size_t r = 0; r < rows.size(); ++r)
    for (const auto& [v, weight] : rows[r])
      if (std::abs(weight) > std::abs(best.weight) && among.contains(v)) best = {r, v, weight};
  return best;
}

// Solves rows for vertices in `among` and substitutes them in the other rows.
void eliminate(std::vector<Weights>& rows, const std::set<int>& among, Dependences& found) {
  for (Entry pivot = largest(rows, among); std::abs(pivot.weight) >= determining_weight_min; pivot = largest(rows, among)) {
    const Weights by = rows[pivot.row];
    rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(pivot.row));
    Dependence& d = found.emplace_back(Dependence{pivot.vertex, {}});
    for (const auto& [v, weight] : by)
      if (v != pivot.vertex) d.on.emplace_back(v, -weight / pivot.weight);
    for (Weights& row : rows) {
      const auto entry = row.find(pivot.vertex);
      if (entry == row.end()) continue;
      const double factor = entry->second;
      row.erase(entry);
      for (const auto& [v, weight] : d.on) row[v] += factor * weight;
      std::erase_if(row, [](const auto& weight) { return std::abs(weight.second) < round_off; });
    }
  }
}

}  // namespace

SolvedJoints solve_joints(std::span<const Joint> joints, const std::vector<AffineFrame>& frames, const std::vector<char>& free, const Dependences& known) {
  IndependentVertices leaves(static_cast<int>(free.size()), known);
  const auto open = [&](int v) { return free[v] && !leaves.depends(v); };
  std::set<int> of_frames, own_vertices;
  for (const AffineFrame& frame : frames)
    for (const int v : frame.frame)
      if (open(v)) of_frames.insert(v);
  std::vector<Weights> rows;
  for (const Joint& joint : joints) {
    for (const int v : joint.own_vertices)
      if (open(v)) own_vertices.insert(v);
    for (const Joint::Relation& relation : joint.relations) {
      Weights& row = rows.emplace_back();
      for (const auto& [v, weight] : relation)
        for (const auto& [leaf, fraction] : leaves.of(v)) row[leaf] += weight * fraction;
      std::erase_if(row, [](const auto& entry) { return std::abs(entry.second) < round_off; });
    }
  }
  SolvedJoints solved;
  eliminate(rows, of_frames, solved.dependences);
  eliminate(rows, own_vertices, solved.dependences);
  solved.redundant = static_cast<int>(rows.size());
  return solved;
}

}  // namespace tack
