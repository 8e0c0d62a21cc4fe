#include "geometry/broad_phase/point_groups.hpp"

#include <algorithm>

#include "geometry/broad_phase/candidates.hpp"
#include "geometry/concatenate.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Returns particle candidates in both directions, (point, other), sorted.
std::vector<std::array<int, 2>> particle_pairs(const Candidates& candidates) {
  auto pairs = candidates.point_point;
  for (const auto& [a, b] : candidates.point_point) pairs.push_back({b, a});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// Returns the runs of pairs with one point and one object. A chunk has the runs that begin in it.
template <class ObjectOf>
std::vector<PointGroup> runs_of(const std::vector<std::array<int, 2>>& pairs, const ObjectOf& object_of,
                                int PointGroup::* begin, int PointGroup::* end) {
  constexpr int chunk = 1024;
  const int n = static_cast<int>(pairs.size());
  std::vector<std::vector<PointGroup>> chunks(chunk_count(n, chunk));
  for_each_chunk(n, [&](int c, int first, int last) {
    const auto in_group = [&](int i, const PointGroup& group) { return pairs[i][0] == group.point && object_of(pairs[i][1]) == group.object; };
    int i = first;
    if (i > 0)
      for (const PointGroup before{pairs[i - 1][0], object_of(pairs[i - 1][1])}; i < last && in_group(i, before);) ++i;
    while (i < last) {
      PointGroup group{pairs[i][0], object_of(pairs[i][1])};
      group.*begin = i;
      while (i < n && in_group(i, group)) ++i;
      group.*end = i;
      chunks[c].push_back(group);
    }
  }, chunk);
  std::vector<PointGroup> groups;
  concatenate(chunks, groups);
  return groups;
}

// Unites the groups of equal point and object.
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

// Sets where the groups were in the list before.
void link(const std::vector<PointGroup>& earlier, std::vector<PointGroup>& groups) {
  for_each_chunk(static_cast<int>(groups.size()), [&](int, int first, int last) {
    auto e = std::lower_bound(earlier.begin(), earlier.end(), groups[first].key(), [](const PointGroup& g, const auto& key) { return g.key() < key; });
    for (int i = first; i < last; ++i) {
      PointGroup& g = groups[i];
      while (e != earlier.end() && e->key() < g.key()) ++e;
      if (e == earlier.end() || e->key() != g.key()) continue;
      g.before = static_cast<int>(e - earlier.begin());
      g.triangle_shift = g.triangle_begin - e->triangle_begin;
    }
  });
}

}  // namespace

void PointGroups::make(const Candidates& candidates, const CollisionMesh& mesh) {
  const std::vector<PointGroup> earlier = std::move(all);
  particles = particle_pairs(candidates);
  all = runs_of(candidates.point_triangle, [&](int t) { return mesh.vertex_object[mesh.triangles[t][0]]; },
                   &PointGroup::triangle_begin, &PointGroup::triangle_end);
  if (!candidates.point_edge.empty() || !particles.empty()) {
    const auto add = [&](const std::vector<PointGroup>& runs) { all.insert(all.end(), runs.begin(), runs.end()); };
    add(runs_of(candidates.point_edge, [&](int e) { return mesh.vertex_object[mesh.edges[e][0]]; }, &PointGroup::edge_begin,
                &PointGroup::edge_end));
    add(runs_of(particles, [&](int v) { return mesh.vertex_object[v]; }, &PointGroup::other_begin, &PointGroup::other_end));
    all = united(std::move(all));
  }
  link(earlier, all);
}

}  // namespace tack
