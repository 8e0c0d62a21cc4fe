#include "framework/contact/point_groups.hpp"

#include <algorithm>

namespace tack {
namespace {

// Particle candidates in both directions, (point, other), sorted.
std::vector<std::array<int, 2>> particle_pairs(const Candidates& candidates) {
  auto pairs = candidates.point_point;
  for (const auto& [a, b] : candidates.point_point) pairs.push_back({b, a});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template <class ObjectOf>
void add_runs(const std::vector<std::array<int, 2>>& pairs, const ObjectOf& object_of,
              int PointGroup::* begin, int PointGroup::* end, std::vector<PointGroup>& groups) {
  for (int i = 0; i < static_cast<int>(pairs.size());) {
    PointGroup group{pairs[i][0], object_of(pairs[i][1])};
    group.*begin = i;
    while (i < static_cast<int>(pairs.size()) && pairs[i][0] == group.point &&
           object_of(pairs[i][1]) == group.object)
      ++i;
    group.*end = i;
    groups.push_back(group);
  }
}

// Unites the groups of the same point and object.
std::vector<PointGroup> united(std::vector<PointGroup> groups) {
  const auto key = [](const PointGroup& g) { return std::array{g.point, g.object}; };
  std::stable_sort(groups.begin(), groups.end(),
                   [&](const PointGroup& a, const PointGroup& b) { return key(a) < key(b); });
  size_t kept = 0;
  for (const PointGroup& g : groups) {
    if (kept > 0 && key(groups[kept - 1]) == key(g)) {
      PointGroup& u = groups[kept - 1];
      if (g.edge_end > g.edge_begin) u.edge_begin = g.edge_begin, u.edge_end = g.edge_end;
      if (g.other_end > g.other_begin) u.other_begin = g.other_begin, u.other_end = g.other_end;
    } else {
      groups[kept++] = g;
    }
  }
  groups.resize(kept);
  return groups;
}

}  // namespace

void PointGroups::make(const Candidates& candidates, const CollisionMesh& mesh) {
  particles = particle_pairs(candidates);
  groups.clear();
  add_runs(candidates.point_triangle, [&](int t) { return mesh.vertex_object[mesh.triangles[t][0]]; },
           &PointGroup::triangle_begin, &PointGroup::triangle_end, groups);
  if (candidates.point_edge.empty() && particles.empty()) return;
  add_runs(candidates.point_edge, [&](int e) { return mesh.vertex_object[mesh.edges[e][0]]; },
           &PointGroup::edge_begin, &PointGroup::edge_end, groups);
  add_runs(particles, [&](int v) { return mesh.vertex_object[v]; }, &PointGroup::other_begin,
           &PointGroup::other_end, groups);
  groups = united(std::move(groups));
}

}  // namespace tack
